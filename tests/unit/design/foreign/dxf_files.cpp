// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "tests/unit/design/foreign/foreign_file.hpp"

namespace graben::test {
namespace {

using Corner = std::array<const char*, 3>;
constexpr Corner kA{"1000.0", "2000.0", "50.0"};
constexpr Corner kB{"1010.0", "2000.0", "50.2"};
constexpr Corner kC{"1010.0", "2006.0", "50.8"};
constexpr Corner kD{"1000.0", "2006.0", "50.6"};

std::string corner(const Corner& at, int which) {
  std::string text;
  for (unsigned axis = 0; axis < 3; ++axis) {
    text += std::to_string(10 * (static_cast<int>(axis) + 1) + which) + "\n" + at[axis] + "\n";
  }
  return text;
}

/// Without a fourth corner where it has none.
std::string face(const Corner& a, const Corner& b, const Corner& c, const Corner* d = nullptr,
                 const char* layer = "DGM") {
  return std::string("0\n3DFACE\n8\n") + layer + "\n" + corner(a, 0) + corner(b, 1) + corner(c, 2) +
         (d == nullptr ? "" : corner(*d, 3));
}

std::string section(const char* name, const std::string& inside) {
  return std::string("0\nSECTION\n2\n") + name + "\n" + inside + "0\nENDSEC\n";
}

std::string header(const char* unit) {
  return section("HEADER", std::string("9\n$ACADVER\n1\nAC1015\n9\n$DIMBLK\n2\nENTITIES\n9\n"
                                       "$INSUNITS\n70\n") +
                               unit + "\n9\n$ORTHOMODE\n70\n1\n");
}

std::string drawing(const std::string& entities, const std::string& before = header("6")) {
  return before + section("ENTITIES", entities) + "0\nEOF\n";
}

/// As CAD of Windows has it: codes to the right, CRLF.
std::string padded(const std::string& text) {
  std::string wide = "999\r\nmade by hand\r\n";
  bool is_code = true;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at);
    const std::string line = text.substr(at, end - at);
    wide += (is_code ? std::string(3 - std::min<std::size_t>(3, line.size()), ' ') : "") + line +
            "\r\n";
    is_code = !is_code;
    at = end + 1;
  }
  return wide;
}

const std::string kTwo = face(kA, kB, kC, &kC) + face(kA, kC, kD, &kD);
const std::string kQuad = face(kA, kB, kC, &kD);
const std::string kBeside =
    "0\nLINE\n8\nDGM\n10\n0\n20\n0\n30\n0\n11\n9\n21\n9\n31\n9\n0\nTEXT\n8\nT\n10\n0\n20\n0\n1\n"
    "SECTION\n0\nINSERT\n8\nT\n2\nTREE\n10\n0\n20\n0\n";
const std::string kTree = section("BLOCKS", "0\nBLOCK\n2\nTREE\n0\nCIRCLE\n8\n0\n0\nENDBLK\n");
const std::string kBlock =
    section("BLOCKS",
            "0\nBLOCK\n2\nOUTER\n0\nINSERT\n8\n0\n2\nGROUND\n0\nENDBLK\n0\nBLOCK\n2\n"
            "GROUND\n" +
                face(kA, kB, kC, nullptr, "0") + "0\nENDBLK\n");
constexpr Corner kAside{"1000.0", "2006.0", "51.0"};
constexpr Corner kOver{"1000.0", "2000.0", "60.0"};

}  // namespace

std::vector<ForeignFile> dxf_files() {
  const std::string whole = drawing(kTwo);
  const std::string r12 = section("ENTITIES", kTwo) + "0\nEOF\n";
  const std::string layers = drawing(kTwo + face(kA, kB, kAside, nullptr, "EXISTING"));
  const std::string mesh =
      drawing(kTwo + "0\nPOLYLINE\n8\nDGM\n66\n1\n70\n64\n0\nVERTEX\n8\nDGM\n0\nSEQEND\n");
  std::string comma = whole;
  comma.replace(comma.find("50.8"), 4, "50,8");
  std::string shifted = whole;
  shifted.erase(shifted.find("3DFACE\n"), 7);
  return {
      {"triangles as four corners, metres", "a.dxf", whole},
      {"no header, metres as told", "a.DXF", r12, "", "", "m"},
      {"one face of four corners in feet", "a.dxf", drawing(kQuad, header("2")), "", "", "",
       kFoot_m},
      {"three corners, US survey feet", "a.dxf",
       drawing(face(kA, kB, kC) + face(kA, kC, kD), header("21")), "", "", "", kSurveyFoot_m},
      {"told, another unit than its template's", "a.dxf", drawing(kTwo, header("4")), "", "", "m"},
      {"CRLF, blanks, a comment", "a.dxf", padded(whole)},
      {"by what it contains", "a.txt", whole},
      {"lines, text and a tree beside", "a.dxf", drawing(kBeside + kTwo, header("6") + kTree)},
      {"one of its layers", "a.dxf", layers, "DGM"},
      {"on paper: not there", "a.dxf", drawing(kTwo + face(kA, kB, kAside) + "67\n1\n")},
      {"upright, seen from above a line", "a.dxf", drawing(kTwo + face(kA, kB, kOver))},
      {"a layer apart from a mesh", "a.dxf", drawing(kTwo + "0\nMESH\n8\nHOUSE\n"), "DGM"},
      {"binary",
       "a.dxf",
       std::string("AutoCAD Binary DXF\r\n\x1A\0", 22),
       "",
       "",
       "",
       1.0,
       0.0,
       {"is a binary DXF; allowed: DXF of text"}},
      {"no unit", "a.dxf", r12, "", "", "", 1.0, 0.0, {"$INSUNITS", "allowed: --units"}},
      {"a unit of space",
       "a.dxf",
       drawing(kTwo, header("19")),
       "",
       "",
       "",
       1.0,
       0.0,
       {"line 16: $INSUNITS 19"}},
      {"two layers, none told",
       "a.dxf",
       layers,
       "",
       "",
       "",
       1.0,
       0.0,
       {"layers 'DGM' (2), 'EXISTING' (1) by --surface"}},
      {"a layer that is not there",
       "a.dxf",
       layers,
       "FG",
       "",
       "",
       1.0,
       0.0,
       {"no 3DFACE on layer 'FG'"}},
      {"a polyface mesh beside",
       "a.dxf",
       mesh,
       "",
       "",
       "",
       1.0,
       0.0,
       {"line 84: <POLYLINE> on layer 'DGM' beside the 3DFACEs"}},
      {"ground in a block in a block",
       "a.dxf",
       drawing(kTwo + "0\nINSERT\n8\nDGM\n2\nOUTER\n", header("6") + kBlock),
       "",
       "",
       "",
       1.0,
       0.0,
       {"<INSERT> of block 'OUTER', which has faces"}},
      {"the same, of the layer that is told",
       "a.dxf",
       drawing(kTwo + "0\nINSERT\n8\nDGM\n2\nOUTER\n", header("6") + kBlock),
       "DGM",
       "",
       "",
       1.0,
       0.0,
       {"<INSERT> of block 'OUTER', which has faces"}},
      {"cut off between two faces",
       "a.dxf",
       whole.substr(0, whole.rfind("0\n3DFACE")),
       "",
       "",
       "",
       1.0,
       0.0,
       {"line 54: ends without EOF"}},
      {"cut off in a group",
       "a.dxf",
       whole.substr(0, whole.rfind("0\n3DFACE") + 2),
       "",
       "",
       "",
       1.0,
       0.0,
       {"line 55: the file ends after the code 0"}},
      {"a decimal comma",
       "a.dxf",
       comma,
       "",
       "",
       "",
       1.0,
       0.0,
       {"line 48: <3DFACE> group 32", "'50,8' has a decimal comma"}},
      {"a line lost", "a.dxf", shifted, "", "", "", 1.0, 0.0, {"as a group's code"}},
      {"four corners in no plane",
       "a.dxf",
       drawing(face(kA, kB, kC, &kAside)),
       "",
       "",
       "",
       1.0,
       0.0,
       {"line 28: <3DFACE> of four corners, whose diagonals pass 0."}},
      {"a corner without its height",
       "a.dxf",
       drawing("0\n3DFACE\n8\nDGM\n" + corner(kA, 0) + corner(kB, 1) + "12\n1010\n22\n2006\n"),
       "",
       "",
       "",
       1.0,
       0.0,
       {"line 28: <3DFACE> has no group 32"}},
      {"lines alone",
       "a.dxf",
       drawing(kBeside),
       "",
       "",
       "",
       1.0,
       0.0,
       {"has no 3DFACE among its entities (1 INSERT, 1 LINE, 1 TEXT)"}},
      {"far beyond any grid",
       "a.dxf",
       drawing(face({"1e9", "2000", "50"}, kB, kC)),
       "",
       "",
       "",
       1.0,
       0.0,
       {"line 28: <3DFACE> x = 1000000000 m"}},
      {"a DWG", "a.dxf", "AC1032\n\n\n", "", "", "", 1.0, 0.0, {"is a DWG; allowed: DXF"}},
      {"an archive", "a.kmz", "PK\3\4abc", "", "", "", 1.0, 0.0, {"is an archive"}},
      {"words of columns", "a.dxf", whole, "", "XYZ", "", 1.0, 0.0, {"--columns are of points"}},
      {"no DXF at all",
       "a.dxf",
       "hello\nworld\n",
       "",
       "",
       "",
       1.0,
       0.0,
       {"line 1: 'hello' as a group's code"}},
      {"empty", "a.dxf", "", "", "", "", 1.0, 0.0, {"ends without EOF"}},
  };
}

}  // namespace graben::test
