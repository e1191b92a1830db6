// SPDX-License-Identifier: Apache-2.0
#include "app/design/surface.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/design/written_file.hpp"

using test::has;

const char* const kMetres = "<Units><Metric linearUnit=\"meter\"/></Units>\n";

std::string surface(const std::string& name, const std::string& points, const std::string& faces) {
  return "<Surface name=\"" + name + "\"><Definition surfType=\"TIN\">\n<Pnts>\n" + points +
         "</Pnts>\n<Faces>\n" + faces + "</Faces></Definition></Surface>\n";
}

std::string file_of(const std::string& units, const std::string& surfaces) {
  return "<?xml version=\"1.0\"?>\n<LandXML version=\"1.2\">\n" + units + "<Surfaces>\n" +
         surfaces + "</Surfaces></LandXML>\n";
}

const char* const kPoints =
    "<P id=\"1\">200.0 100.0 1.0</P>\n<P id=\"2\">200.0 110.0 2.0</P>\n"
    "<P id=\"7\"> 210.0\n 100.0 3.0 </P>\n<P id=\"8\">210.0 110.0 4.0</P>\n";
const char* const kFaces = "<F>1 2 7</F>\n<F i=\"1\">1 2 8</F>\n<F n=\"1 0 0\">2 8 7</F>\n";

design::Surface read(const std::string& text, const std::string& name = "") {
  const test::WrittenFile file("surface.xml", text);
  return design::read_landxml(file.path(), name);
}

std::string refusal(const std::string& text, const std::string& name = "") {
  return test::refusal_of([&] { static_cast<void>(read(text, name)); });
}

/// LandXML's order is north, east, height; ids are any numbers; an invisible face is none.
TEST(points_and_faces_arrive) {
  const design::Surface got = read(file_of(kMetres, surface("a", kPoints, kFaces)));
  assert_int_equal(got.point_m.size(), 4);
  assert_int_equal(got.face.size(), 2);
  const Eigen::Vector3d& third = got.point_m[got.face[0][2]];
  assert_near(third.x(), 100.0, 0.0);
  assert_near(third.y(), 210.0, 0.0);
  assert_near(third.z(), 3.0, 0.0);
  assert_near(got.point_m[got.face[1][1]].z(), 4.0, 0.0);
}

/// What an exporter notes between two numbers ends nothing.
TEST(comments_may_stand_between_words) {
  const design::Surface got = read(file_of(
      kMetres, surface("a",
                       "<P id=\"1\">200.0 <!-- north --> 100.0 1.0</P>\n<P id=\"2\"><!-- first "
                       "-->200.0 110.0<Feature code=\"k\"/> 2.0</P>\n<P id=\"7\">210.0 "
                       "<![CDATA[100.0]]> 3.0</P>\n",
                       "<F>1 <!-- then --> 2 7</F>\n")));
  assert_near((got.point_m[0] - Eigen::Vector3d(100.0, 200.0, 1.0)).norm(), 0.0, 0.0);
  assert_near((got.point_m[1] - Eigen::Vector3d(110.0, 200.0, 2.0)).norm(), 0.0, 0.0);
  assert_near((got.point_m[2] - Eigen::Vector3d(100.0, 210.0, 3.0)).norm(), 0.0, 0.0);
  assert_int_equal(got.face.size(), 1);
}

TEST(units_are_turned_to_metres) {
  const auto east_m = [](const char* units) {
    return read(file_of(units, surface("a", kPoints, kFaces))).point_m[0].x();
  };
  assert_near(east_m("<Units><Imperial linearUnit=\"foot\"/></Units>"), 30.48, 1e-12);
  assert_near(east_m("<Units><Imperial linearUnit=\"USSurveyFoot\"/></Units>"),
              100.0 * 1200.0 / 3937.0, 1e-12);
  assert_near(east_m("<Units><Metric linearUnit=\"millimeter\"/></Units>"), 0.1, 1e-12);
  assert_true(has(refusal(file_of("<Units><Metric linearUnit=\"ell\"/></Units>",
                                  surface("a", kPoints, kFaces))),
                  "line 3, <Metric>: linearUnit=\"ell\"; allowed: meter"));
  assert_true(has(refusal(file_of("", surface("a", kPoints, kFaces))), "says no unit of length"));
}

TEST(one_surface_of_several_is_chosen_by_its_name) {
  const std::string two = file_of(
      kMetres, surface("ground", kPoints, "<F>1 2 7</F>\n") + surface("design", kPoints, kFaces));
  assert_int_equal(read(two, "design").face.size(), 2);
  assert_int_equal(read(two, "ground").face.size(), 1);
  assert_true(has(refusal(two), "allowed: one of #1 'ground', #2 'design', by --surface"));
  assert_true(has(refusal(two, "other"), "surface 'other' is there 0 times"));
}

TEST(what_is_malformed_is_refused_with_its_element) {
  const auto points = [](const std::string& more) {
    return refusal(
        file_of(kMetres, surface("a", kPoints + more, kFaces + std::string("<F>1 2 9</F>\n"))));
  };
  const auto faces = [](const std::string& more) {
    return refusal(file_of(kMetres, surface("a", kPoints, kFaces + more)));
  };
  assert_true(has(points("<P id=\"9\">1.0 2.0</P>"),
                  "line 12, <P id=\"9\">: 2 numbers; allowed: 3, north, east and height"));
  assert_true(has(points("<P id=\"9\">1.0 abc 2.0</P>"), "'abc' as its east; allowed: -20000000"));
  assert_true(has(points("<P id=\"9\">1.0 2.0 nan</P>"), "'nan' as its height"));
  assert_true(has(points("<P id=\"9\">1.0 2.0 20000</P>"), "allowed: -10000 .. 10000 m"));
  assert_true(has(points("<P id=\"2\">1.0 2.0 3.0</P>"), "its id is there for the second time"));
  assert_true(has(points("<P>1.0 2.0 3.0</P>"), "point '9' is not there; allowed: the ids of <P>"));
  assert_true(has(faces("<F>1 2 99</F>"), "line 17, <F>: point '99' is not there"));
  assert_true(has(faces("<F>1 2 7 8</F>"), "<F>: more than 3 points; allowed: 3"));
  assert_true(has(refusal("<LandXML><Units>"), "can't be read as XML"));
  assert_true(has(refusal("<Other/>"), "allowed: LandXML as the outermost element"));
  assert_true(has(refusal(file_of(kMetres, "")), "has no <Surface>"));
  assert_true(has(refusal(file_of(kMetres, surface("a", kPoints, ""))), "has no face"));
  assert_true(has(
      refusal(file_of(kMetres, "<Surface name=\"a\"><Definition surfType=\"grid\"/></Surface>")),
      "surfType=\"grid\"; allowed: TIN"));
}

/// Exporters put each surface into a group of its own, ground and design.
TEST(all_groups_are_looked_through) {
  const std::string two =
      "<LandXML>" + std::string(kMetres) + "<Surfaces name=\"existing\">" +
      surface("EG", kPoints, "<F>1 2 7</F>\n") + "</Surfaces>\n<Surfaces name=\"design\">" +
      surface("FG\" state=\"proposed", kPoints, kFaces) + "</Surfaces></LandXML>";
  assert_true(has(refusal(two), "allowed: one of #1 'EG', #2 'FG' (proposed), by --surface"));
  assert_int_equal(read(two, "EG").face.size(), 1);
  assert_int_equal(read(two, "FG").face.size(), 2);
  assert_int_equal(read(two, "#2").face.size(), 2);
  assert_int_equal(read(two, "state=proposed").face.size(), 2);
}

/// Neither is the first of two taken.
TEST(two_of_what_is_there_once_are_refused) {
  std::string twice = file_of(kMetres, surface("a", kPoints, kFaces));
  twice.replace(twice.find("</Definition>"), 13, "</Definition><Definition surfType=\"TIN\"/>");
  assert_true(has(refusal(twice), "<Definition>: is the surface's second one; allowed: one"));
  const auto with = [](const std::string& units) {
    return refusal(file_of("<Units>" + units + "</Units>", surface("a", kPoints, kFaces)));
  };
  const std::string metre = "<Metric linearUnit=\"meter\"/>";
  const std::string foot = "<Imperial linearUnit=\"foot\"/>";
  assert_true(has(with(metre + foot), "<Imperial>: says another unit of length than <Metric>"));
  assert_true(has(with(metre + "</Units><Units>" + foot), "<Imperial>: says another unit"));
  assert_true(has(with(metre + "<Feature/>" + metre + foot), "<Imperial>: says another unit"));
  assert_string_equal(with(metre + metre + "<Feature/>").c_str(), "");
}

TEST(names_that_say_nothing_take_a_number) {
  const std::string twice =
      file_of(kMetres, surface("FG", kPoints, "<F>1 2 7</F>\n") + surface("FG", kPoints, kFaces));
  assert_true(has(refusal(twice, "FG"), "surface 'FG' is there 2 times; allowed: one of #1 'FG'"));
  assert_int_equal(read(twice, "#2").face.size(), 2);
  assert_true(has(refusal(twice, "#3"), "is there 0 times"));
  assert_int_equal(read(file_of(kMetres, surface("", kPoints, kFaces))).face.size(), 2);
  const std::string unnamed =
      file_of(kMetres, surface("", kPoints, "<F>1 2 7</F>\n") + surface("FG", kPoints, kFaces));
  assert_int_equal(read(unnamed, "#1").face.size(), 1);
  assert_true(has(refusal(unnamed), "#1 ''"));
}

TEST(what_no_face_uses_is_not_judged) {
  const std::string more =
      "<P id=\"99\">0 0 -99999</P>\n<P id=\"98\">0 0</P>\n<P id=\"97\">0 0 0</P>\n<P>0 0 0</P>\n";
  const design::Surface got = read(file_of(kMetres, surface("a", kPoints + more, kFaces)));
  assert_int_equal(got.point_m.size(), 4);
  assert_near(got.point_m[got.face[1][1]].z(), 4.0, 0.0);
  // The same place twice is one point.
  assert_int_equal(
      read(file_of(kMetres,
                   surface("a", kPoints + std::string("<P id=\"2\">200.0 110.0 2</P>"), kFaces)))
          .point_m.size(),
      4);
}

TEST(a_prefix_is_read_and_anothers_element_is_not) {
  const std::string text =
      "\xEF\xBB\xBF<?xml version=\"1.0\"?>\n<lx:LandXML xmlns:lx=\"http://www.landxml.org/schema/"
      "LandXML-1.2\" xmlns:v=\"http://vendor.example/more\">\n<lx:Units><lx:Metric "
      "linearUnit=\"meter\"/></lx:Units><lx:Surfaces><v:Surface name=\"not\"/><lx:Surface "
      "name=\"FG\"><lx:Definition surfType=\"TIN\"><lx:Pnts><lx:P id=\"1\">0 0 1</lx:P><lx:P "
      "id=\"2\">0 9 1</lx:P><lx:P id=\"3\">9 9 1</lx:P></lx:Pnts><lx:Faces><lx:F>1 2 3</lx:F>"
      "</lx:Faces></lx:Definition></lx:Surface></lx:Surfaces></lx:LandXML>\n";
  assert_int_equal(read(text).face.size(), 1);
}

TEST(mirrored_axes_are_refused) {
  const auto with = [](const std::string& system) {
    return refusal(
        file_of("<CoordinateSystem " + system + "/>" + kMetres, surface("a", kPoints, kFaces)));
  };
  assert_true(has(with("ogcWktCode='PROJCS[&quot;Lo29&quot;,AXIS[&quot;X&quot;,SOUTH],"
                       "AXIS[&quot;Y&quot;,WEST]]'"),
                  "<CoordinateSystem>: its axes count to the south or west"));
  assert_true(has(with("epsgCode=\"2053\""), "mirrors left and right"));
  assert_true(with("epsgCode=\"25832\" ogcWktCode='PROJCS[&quot;Western&quot;,AXIS[&quot;N&quot;,"
                   "NORTH]]'")
                  .empty());
}
