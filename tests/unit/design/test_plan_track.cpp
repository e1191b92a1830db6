// SPDX-License-Identifier: Apache-2.0
#include "app/design/curved_section.hpp"

#include <cmath>

#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/design/written_file.hpp"

using test::has;

constexpr double kHalfPi = 1.57079632679489662;
const design::BladeAcross kTilts{2.5, 0.02, true};

std::string file_of(const std::string& geometry, const std::string& unit = "meter") {
  return "<?xml version=\"1.0\"?>\n<LandXML version=\"1.2\">\n<Units><Metric linearUnit=\"" + unit +
         "\"/></Units>\n<Alignments><Alignment name=\"way\" staStart=\"100\">\n<CoordGeom>\n" +
         geometry + "</CoordGeom></Alignment></Alignments></LandXML>\n";
}

/// Ten metres east, a quarter of a circle to the left, ten metres north.
const std::string kLine = "<Line><Start>0 0</Start><End>0 10</End></Line>\n";
const std::string kCurve =
    "<Curve rot=\"ccw\"><Start>0 10</Start><Center>20 10</Center><End>20 30</End></Curve>\n";
const std::string kNorth = "<Line><Start>20 30</Start><End>30 30</End></Line>\n";

design::PlanTrack read(const std::string& text, const design::AlignmentSource& source = {}) {
  const test::WrittenFile file("way.xml", text);
  return design::read_alignment(file.path(), source);
}

std::string refusal(const std::string& text, const design::AlignmentSource& source = {}) {
  return test::refusal_of([&] { static_cast<void>(read(text, source)); });
}

void assert_at(const design::PlanTrack& track, double station_m, double x_m, double y_m,
               double direction_rad) {
  const design::PlanStation at = design::station_of(track, station_m);
  assert_near(at.piece->at_m(at.along_m).x(), x_m, 1e-9);
  assert_near(at.piece->at_m(at.along_m).y(), y_m, 1e-9);
  assert_near(at.piece->direction_at_rad(at.along_m), direction_rad, 1e-9);
}

TEST(an_alignment_is_lines_and_arcs) {
  const design::PlanTrack track = read(file_of(kLine + kCurve + kNorth));
  assert_int_equal(track.piece.size(), 3);
  assert_near(track.length_m(), 20.0 + 20.0 * kHalfPi, 1e-9);
  assert_near(track.piece[1].curvature_pm, 0.05, 1e-12);
  assert_at(track, 5.0, 5.0, 0.0, 0.0);
  assert_at(track, 10.0 + 10.0 * kHalfPi, 10.0 + 20.0 * std::sin(0.5 * kHalfPi),
            20.0 - 20.0 * std::cos(0.5 * kHalfPi), 0.5 * kHalfPi);
  assert_at(track, track.length_m() - 1.0, 30.0, 29.0, kHalfPi);
  // To the right, and in another unit.
  const design::PlanTrack right = read(file_of(
      "<Curve rot=\"cw\"><Start>0 0</Start><Center>-20 0</Center><End>-20 20</End></Curve>\n",
      "centimeter"));
  assert_near(right.piece[0].curvature_pm, -5.0, 1e-9);
  assert_near(right.length_m(), 0.2 * kHalfPi, 1e-9);
}

TEST(a_part_of_it_is_taken_by_its_stations) {
  const design::PlanTrack part = read(file_of(kLine + kCurve + kNorth), {"way", {105.0, 112.0}});
  assert_int_equal(part.piece.size(), 2);
  assert_near(part.length_m(), 7.0, 1e-9);
  assert_at(part, 0.0, 5.0, 0.0, 0.0);
  const std::string beyond = refusal(file_of(kLine), {"way", {99.0, 112.0}});
  assert_true(has(beyond, "station 99 m is not there; allowed: 100.000 .. 110.000 m"));
  assert_true(has(refusal(file_of(kLine), {"away", {}}), "alignment 'away' is there 0 times"));
}

TEST(what_it_cant_be_is_refused_with_its_element) {
  assert_true(has(refusal(file_of(kLine + "<Spiral length=\"5\"/>\n")),
                  "line 7, <Spiral>: allowed in an alignment: <Line>, <Curve>"));
  const std::string apart = "<Line><Start>0 11</Start><End>0 20</End></Line>\n";
  assert_true(has(refusal(file_of(kLine + apart)), "line 7, <Line>: begins 1.000 m from the end"));
  const std::string bent = "<Line><Start>0 10</Start><End>5 20</End></Line>\n";
  assert_true(has(refusal(file_of(kLine + bent)),
                  "bends by 0.4636 rad from the one before at station 10.000 m"));
  assert_true(has(refusal(file_of("<Line><Start>0 0</Start></Line>\n")), "has no <End>"));
  assert_true(
      has(refusal(file_of("<Line><Start>0 x</Start><End>0 1</End></Line>\n")), "'x' as its east"));
  const auto curve = [](const std::string& rot, const std::string& end) {
    return refusal(file_of("<Curve rot=\"" + rot + "\"><Start>0 10</Start><Center>20 10</Center>" +
                           "<End>" + end + "</End></Curve>\n"));
  };
  assert_true(has(curve("left", "20 30"), "rot=\"left\"; allowed: cw, ccw"));
  assert_true(has(curve("ccw", "20 31"), "begins 20.000 m and ends 21.000 m from its centre"));
  assert_true(has(refusal(file_of("")), "has no element"));
}

/// Cut first: what lies beyond the stations may be what it likes.
TEST(only_what_the_stations_use_is_judged) {
  const std::string spiral = "<Spiral length=\"20\" rot=\"ccw\"><Start>0 10</Start></Spiral>\n";
  const std::string bent = "<Line><Start>0 10</Start><End>5 20</End></Line>\n";
  assert_near(read(file_of(kLine + spiral + kNorth), {"way", {101.0, 109.0}}).length_m(), 8.0,
              1e-9);
  assert_near(read(file_of(kLine + bent), {"way", {101.0, 110.0}}).length_m(), 9.0, 1e-9);
  assert_near(read(file_of(kLine + bent), {"way", {110.0, 120.0}}).length_m(), 10.0, 1e-9);
  assert_true(
      has(refusal(file_of(kLine + spiral), {"way", {101.0, 111.0}}), "<Spiral>: allowed in"));
  // Behind an element without a length no station is known.
  const std::string chain = "<Chain/>\n";
  assert_near(read(file_of(kLine + chain + kNorth), {"way", {101.0, 109.0}}).length_m(), 8.0, 1e-9);
  assert_true(has(refusal(file_of(kLine + chain + kNorth), {"way", {111.0, 112.0}}), "<Chain>"));
}

std::string counted_anew(const std::string& equations) {
  return file_of(kLine + "</CoordGeom>" + equations + "\n<CoordGeom>");
}

TEST(stations_are_counted_anew_at_an_equation) {
  // 100 .. 105 before it, 500 .. 505 behind.
  const std::string text =
      counted_anew("<StaEquation staAhead=\"500\" staBack=\"105\" staInternal=\"105\"/>");
  const design::PlanTrack over = read(text, {"way", {101.0, 503.0}});
  assert_near(over.length_m(), 7.0, 1e-9);
  assert_at(over, 0.0, 1.0, 0.0, 0.0);
  assert_at(read(text, {"way", {501.0, 504.0}}), 0.0, 6.0, 0.0, 0.0);
  // The equation's place has both numbers.
  assert_near(read(text, {"way", {105.0, 500.5}}).length_m(), 0.5, 1e-9);
  assert_near(read(text, {"way", {104.0, 500.0}}).length_m(), 1.0, 1e-9);
  assert_near(read(text).length_m(), 10.0, 1e-9);
  assert_true(has(refusal(text, {"way", {101.0, 109.0}}),
                  "station 109 m is not there; allowed: 100.000 .. 105.000, 500.000 .. 505.000 m"));
  assert_true(has(refusal(text, {"way", {501.0, 103.0}}), "stations 501 .. 103 m; allowed: along"));
  // Without staInternal by staBack; stations that fall; two of them.
  assert_near(
      read(counted_anew("<StaEquation staAhead=\"500\" staBack=\"105\"/>"), {"way", {501.0, 504.0}})
          .length_m(),
      3.0, 1e-9);
  const std::string falls = counted_anew(
      "<StaEquation staAhead=\"90\" staInternal=\"104\" staIncrement=\"decreasing\"/>"
      "<StaEquation staAhead=\"7\" staBack=\"88\" staInternal=\"106\"/>");
  assert_at(read(falls, {"way", {89.0, 8.0}}), 0.0, 5.0, 0.0, 0.0);
  assert_near(read(falls, {"way", {89.0, 8.0}}).length_m(), 2.0, 1e-9);
}

TEST(an_equation_leaves_no_station_to_a_guess) {
  const auto says = [](const std::string& equation, const char* what) {
    const std::string error =
        refusal(counted_anew("<StaEquation " + equation + "/>"), {"way", {104.0, 105.5}});
    if (!has(error, what)) {
      fail_msg("no \"%s\" in: %s", what, error.c_str());
    }
  };
  says("staAhead=\"103\" staInternal=\"105\"",
       "station 104 m is there 2 times, 4.000 and 6.000 m from its begin");
  says("staAhead=\"103\" staInternal=\"112\"",
       "<StaEquation>: lies 12.000 m from the alignment's begin");
  says("staAhead=\"500\" staBack=\"104\" staInternal=\"105\"",
       "staBack 104.000 m, where 105.000 m is counted to there");
  says("staAhead=\"5+00\" staInternal=\"105\"", "staAhead=\"5+00\"; allowed: a number");
  says("staInternal=\"105\"", "needs staAhead");
  says("staAhead=\"500\" staInternal=\"105\" staIncrement=\"up\"", "staIncrement=\"up\"");
  std::string words = file_of(kLine);
  words.replace(words.find("=\"100\""), 6, "=\"1+00\"");
  assert_true(has(refusal(words, {"way", {101.0, 109.0}}), "staStart=\"1+00\"; allowed: a number"));
}

TEST(two_geometries_are_refused) {
  const std::string two = file_of(kLine + "</CoordGeom><CoordGeom>" + kLine);
  assert_true(has(refusal(two), "<CoordGeom>: is the alignment's second one; allowed: one"));
}

/// A file whose axes or turns are mirrored has arcs that go round the other way than they say.
TEST(points_and_numbers_beside_them_are_the_same) {
  const auto curve = [](const std::string& more) {
    return file_of("<Curve " + more +
                   "><Start>0 0</Start><Center>20 0</Center><End>20 20</End></Curve>\n");
  };
  assert_near(read(curve("rot=\"ccw\" length=\"31.416\" radius=\"20.00\"")).length_m(), 10.0 * kPi,
              1e-6);
  assert_true(has(refusal(curve("rot=\"cw\" length=\"31.416\"")),
                  "<Curve>: length=\"31.416\", by its points and rot 94.248 m"));
  assert_true(has(refusal(curve("rot=\"ccw\" radius=\"25\"")),
                  "radius=\"25\", by its points and rot 20.000 m"));
  assert_true(
      has(refusal(file_of("<Line length=\"12\"><Start>0 0</Start><End>0 10</End></Line>\n")),
          "length=\"12\", by its points 10.000 m"));
}

TEST(corners_are_rounded_by_arcs) {
  const std::vector<double> corner = {0.0, 0.0, 30.0, 0.0, 30.0, 30.0};
  const design::PlanTrack track = design::rounded_track(corner, 20.0);
  assert_int_equal(track.piece.size(), 3);
  assert_true(track.curves());
  assert_near(track.length_m(), 20.0 + 20.0 * kHalfPi, 1e-9);
  assert_at(track, track.length_m(), 30.0, 30.0, kHalfPi);
  assert_at(track, 10.0, 10.0, 0.0, 0.0);
  assert_false(design::rounded_track({0.0, 0.0, 5.0, 0.0, 9.0, 0.0}, 20.0).curves());
  const std::string refused =
      test::refusal_of([&] { static_cast<void>(design::rounded_track(corner, 31.0)); });
  assert_true(has(refused, "bends by 1.571 rad at x = 30, y = 0 m"));
  assert_true(has(refused, "31.000 m before and behind it"));
}

/// A plane that rises to the east by 0.05 and to the north by 0.02.
design::Surface plane(double most_m) {
  design::Surface surface;
  for (const double x_m : {-10.0, most_m}) {
    for (const double y_m : {-10.0, 60.0}) {
      surface.point_m.emplace_back(x_m, y_m, 7.0 + 0.05 * x_m + 0.02 * y_m);
    }
  }
  surface.face = {{0, 2, 1}, {2, 3, 1}};
  return surface;
}

/// Height under the track, slope at right angles to it: of a plane, by its gradient.
TEST(the_section_follows_the_curve) {
  const design::PlanTrack track = design::rounded_track({0.0, 0.0, 30.0, 0.0, 30.0, 30.0}, 20.0);
  const machines::DesignLine line = design::along_curved_track(plane(60.0), track, 7.0, kTilts);
  assert_int_equal(line.corners.size(), line.cross.size());
  assert_int_equal(line.corners.size(), line.curvature.size());
  assert_near(line.corners.back().x_m, track.length_m(), 1e-4);
  for (std::size_t i = 0; i < line.corners.size(); i += 50) {
    const design::PlanStation at = design::station_of(track, line.corners[i].x_m);
    const Eigen::Vector2d place = at.piece->at_m(at.along_m);
    const double direction = at.piece->direction_at_rad(at.along_m);
    assert_near(line.corners[i].z_m, 0.05 * place.x() + 0.02 * place.y(), 1e-9);
    assert_near(line.cross[i], -0.05 * std::sin(direction) + 0.02 * std::cos(direction), 1e-9);
    assert_near(line.curvature[i], at.piece->curvature_pm, 0.0);
  }
}

TEST(what_cant_be_made_is_refused_with_the_station) {
  const design::PlanTrack track = design::rounded_track({0.0, 0.0, 30.0, 0.0, 30.0, 30.0}, 20.0);
  const auto refused = [&](const design::Surface& surface, const design::BladeAcross& blade) {
    return test::refusal_of(
        [&] { static_cast<void>(design::along_curved_track(surface, track, 7.0, blade)); });
  };
  assert_true(
      has(refused(plane(60.0), {2.5, 0.02, false}), "the track curves from station 10.00 m on"));
  assert_true(has(refused(plane(20.0), kTilts), "the surface has a hole at station 19."));
  design::Surface two = plane(60.0);
  for (const double y_m : {-10.0, 60.0}) {
    two.point_m.emplace_back(60.0, y_m, 9.0);
  }
  two.face.push_back({0, 4, 1});
  assert_true(has(refused(two, kTilts), "allowed: one height a place"));
  const std::string tight = test::refusal_of([&] {
    static_cast<void>(design::along_curved_track(
        plane(60.0), design::rounded_track({0.0, 0.0, 30.0, 0.0, 30.0, 30.0}, 1.5), 7.0, kTilts));
  });
  assert_true(has(tight, "a radius of 1.50 m from station 28.50 m on; allowed: at least 2 m"));
}
