// SPDX-License-Identifier: Apache-2.0
#include "tests/unit/design/foreign/foreign_file.hpp"

namespace graben::test {
namespace {

const std::string kHead =
    "<?xml version=\"1.0\"?>\n<LandXML xmlns=\"http://www.landxml.org/schema/LandXML-1.2\" "
    "version=\"1.2\">\n";
const std::string kMetres = "<Units><Metric linearUnit=\"meter\"/></Units>\n";
/// North, east, height.
const std::string kPoints =
    "<Pnts><P id=\"1\">2000 1000 50</P><P id=\"2\">2000 1010 50.2</P>\n"
    "<P id=\"3\">2006 1010 50.8</P><P id=\"4\">2006 1000 50.6</P></Pnts>\n";
const std::string kFaces = "<Faces><F>1 2 3</F><F>1 3 4</F></Faces>\n";

std::string surface(const std::string& inside, const std::string& attributes = "name=\"FG\"") {
  return "<Surfaces>\n<Surface " + attributes + ">" + inside + "</Surface>\n</Surfaces>\n";
}

std::string tin(const std::string& points = kPoints, const std::string& faces = kFaces) {
  return "<Definition surfType=\"TIN\">\n" + points + faces + "</Definition>";
}

std::string file(const std::string& inside, const std::string& units = kMetres) {
  return kHead + units + inside + "</LandXML>\n";
}

std::string imperial(const char* unit) {
  return std::string("<Units><Imperial areaUnit=\"squareFoot\" linearUnit=\"") + unit +
         "\" volumeUnit=\"cubicYard\"/></Units>\n";
}

/// Each letter with a zero behind it, as UTF-16 has it.
std::string utf16(const std::string& text) {
  std::string wide = "\xFF\xFE";
  for (const char letter : text) {
    wide += letter;
    wide += '\0';
  }
  return wide;
}

const std::string kBreaklines =
    "<SourceData><Breaklines><Breakline brkType=\"standard\"><PntList3D>2000 1000 99 2006 1010 99"
    "</PntList3D></Breakline></Breaklines></SourceData>";

}  // namespace

std::vector<ForeignFile> landxml_files() {
  const std::string prefixed =
      "<lx:LandXML xmlns:lx=\"http://www.landxml.org/schema/LandXML-1.1\"><lx:Units><lx:Metric "
      "linearUnit=\"millimeter\"/></lx:Units><lx:Surfaces><lx:Surface name=\"a\"><lx:Definition "
      "surfType=\"TIN\"><lx:Pnts><lx:P id=\"1\">2000 1000 50</lx:P><lx:P id=\"2\">2000 1010 50.2"
      "</lx:P><lx:P id=\"3\">2006 1010 50.8</lx:P><lx:P id=\"4\">2006 1000 50.6</lx:P></lx:Pnts>"
      "<lx:Faces><lx:F>1 2 3</lx:F><lx:F>1 3 4</lx:F></lx:Faces></lx:Definition></lx:Surface>"
      "</lx:Surfaces></lx:LandXML>";
  const std::string two =
      "<Surfaces>\n<Surface name=\"EG\" state=\"existing\">" +
      tin("<Pnts><P id=\"1\">0 0 0</P><P id=\"2\">0 9 0</P><P id=\"3\">9 0 0</P></Pnts>",
          "<Faces><F>1 2 3</F></Faces>") +
      "</Surface><Surface name=\"FG\" state=\"proposed\">" + tin() + "</Surface></Surfaces>\n";
  return {
      {"breaklines beside the faces are no ground", "a.xml", file(surface(kBreaklines + tin()))},
      {"a prefix for the namespace, mm", "a.xml", prefixed, "", "", "", 1e-3},
      {"feet", "a.xml", file(surface(tin()), imperial("foot")), "", "", "", kFoot_m},
      {"US survey feet", "a.xml", file(surface(tin()), imperial("USSurveyFoot")), "", "", "",
       kSurveyFoot_m},
      {"a hole: a face that is not seen", "a.xml",
       file(surface(tin(kPoints, "<Faces><F>1 2 3</F><F i=\"1\">1 3 4</F></Faces>"))), "", "", "",
       1.0, 30.0},
      {"one of two by its state", "a.xml", file(two), "state=proposed"},
      {"UTF-16", "a.xml", utf16(file(surface(tin())))},
      {"another ending", "a.jxl", file(surface(tin()))},
      {"two, none told",
       "a.xml",
       file(two),
       "",
       "",
       "",
       1.0,
       0.0,
       {"line 4, <Surfaces>", "#1 'EG' (existing), #2 'FG' (proposed)"}},
      {"cut off",
       "a.xml",
       file(surface(tin())).substr(0, 300),
       "",
       "",
       "",
       1.0,
       0.0,
       {"line 7: can't be read as XML"}},
      {"a face of a point that is not there",
       "a.xml",
       file(surface(tin(kPoints, "<Faces><F>1 2 3</F>\n<F>1 3 9</F></Faces>"))),
       "",
       "",
       "",
       1.0,
       0.0,
       {"line 9, <F>", "point '9' is not there"}},
      {"a grid",
       "a.xml",
       file(surface("<Definition surfType=\"grid\"></Definition>")),
       "",
       "",
       "",
       1.0,
       0.0,
       {"line 5, <Definition>", "surfType=\"grid\"; allowed: TIN"}},
      {"no unit",
       "a.xml",
       file(surface(tin()), ""),
       "",
       "",
       "",
       1.0,
       0.0,
       {"line 2, <LandXML", "says no unit of length"}},
      {"a decimal comma",
       "a.xml",
       file(surface(tin("<Pnts><P id=\"1\">2000,5 1000 50</P><P id=\"2\">2000 1010 50.2</P>\n"
                        "<P id=\"3\">2006 1010 50.8</P></Pnts>\n",
                        "<Faces><F>1 2 3</F></Faces>"))),
       "",
       "",
       "",
       1.0,
       0.0,
       {"<P id=\"1\">", "'2000,5' as its north"}},
      {"points by reference",
       "a.xml",
       file(surface(tin("<Pnts>\n<P id=\"1\" pntRef=\"1\"/><P id=\"2\" pntRef=\"2\"/><P id=\"3\" "
                        "pntRef=\"3\"/></Pnts>",
                        "<Faces><F>1 2 3</F></Faces>"))),
       "",
       "",
       "",
       1.0,
       0.0,
       {"line 7, <P id=\"1\">", "0 numbers"}},
      {"axes to the south",
       "a.xml",
       file("<CoordinateSystem epsgCode=\"2053\"/>\n" + surface(tin())),
       "",
       "",
       "",
       1.0,
       0.0,
       {"line 4, <CoordinateSystem>", "mirrors left and right"}},
      {"alignments alone",
       "a.xml",
       file("<Alignments></Alignments>"),
       "",
       "",
       "",
       1.0,
       0.0,
       {"has no <Surface>"}},
      {"another XML",
       "a.xml",
       "<?xml version=\"1.0\"?>\n<kml></kml>\n",
       "",
       "",
       "",
       1.0,
       0.0,
       {"line 2, <kml>", "allowed: LandXML"}},
  };
}

}  // namespace graben::test
