// SPDX-License-Identifier: Apache-2.0
#include "app/built/built_files.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <iterator>
#include <limits>
#include <stdexcept>

namespace graben::built {
namespace {

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char letter : text) {
    switch (letter) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      default:
        // XML has no other control characters; a name needs none.
        safe += static_cast<unsigned char>(letter) < ' ' ? ' ' : letter;
    }
  }
  return safe;
}

const char* height_words(BuiltHeight height) {
  return height == BuiltHeight::kLowest ? "lowest place of the cutting edge"
                                        : "newest place of the cutting edge";
}

/// Least and most of the heights, and of the cells along x and y.
struct Extent {
  double low_m = 0.0;
  double high_m = 0.0;
  CellPlace first;
  CellPlace last;
};

Extent extent_of(const BuiltGround& ground) {
  const BuiltPoint& one = ground.point.front();
  Extent extent{one.at_m.z(), one.at_m.z(), one.cell, one.cell};
  for (const BuiltPoint& point : ground.point) {
    extent.low_m = std::min(extent.low_m, point.at_m.z());
    extent.high_m = std::max(extent.high_m, point.at_m.z());
    extent.first = {std::min(extent.first.i, point.cell.i), std::min(extent.first.j, point.cell.j)};
    extent.last = {std::max(extent.last.i, point.cell.i), std::max(extent.last.j, point.cell.j)};
  }
  return extent;
}

std::string of_machine(const BuiltHead& head) {
  return fmt::format("{}, {} to {}", head.machine, utc_text(head.from_s), utc_text(head.until_s));
}

}  // namespace

std::string utc_text(double time_s, int decimals) {
  const double unit = std::pow(10.0, decimals);
  const auto parts = static_cast<long long>(std::floor(time_s * unit + 0.5));
  const auto per_s = static_cast<long long>(unit);
  const auto whole = static_cast<std::time_t>(parts / per_s);
  std::string text = fmt::format("{:%Y-%m-%dT%H:%M:%S}", fmt::gmtime(whole));
  if (decimals > 0) {
    text += fmt::format(".{:0{}}", parts % per_s, decimals);
  }
  return text + "Z";
}

std::string landxml_text(const BuiltGround& ground, const BuiltHead& head) {
  const std::string date = utc_text(head.until_s);
  const Extent extent = extent_of(ground);
  fmt::memory_buffer text;
  auto to = std::back_inserter(text);
  fmt::format_to(
      to,
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<LandXML xmlns=\"http://www.landxml.org/schema/LandXML-1.2\" "
      "xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" "
      "xsi:schemaLocation=\"http://www.landxml.org/schema/LandXML-1.2 "
      "http://www.landxml.org/schema/LandXML-1.2/LandXML-1.2.xsd\" version=\"1.2\" date=\"{}\" "
      "time=\"{}\" language=\"English\" readOnly=\"false\">\n"
      "<Units><Metric areaUnit=\"squareMeter\" linearUnit=\"meter\" volumeUnit=\"cubicMeter\" "
      "temperatureUnit=\"celsius\" pressureUnit=\"HPA\" angularUnit=\"radians\" "
      "directionUnit=\"radians\"/></Units>\n"
      "<Project name=\"{}\" desc=\"{}\"/>\n"
      "<Application name=\"graben\" version=\"{}\"/>\n",
      date.substr(0, 10), date.substr(11, 8), escaped(head.project),
      escaped("As built by " + of_machine(head)), escaped(head.version));
  fmt::format_to(to,
                 "<Surfaces><Surface name=\"As built\" desc=\"{}\" state=\"existing\">\n"
                 "<Definition surfType=\"TIN\" area2DSurf=\"{:.3f}\" elevMax=\"{:.4f}\" "
                 "elevMin=\"{:.4f}\">\n<Pnts>\n",
                 escaped(fmt::format("{}; {}, grid of {} m, frame of the machine: north is y, "
                                     "east is x",
                                     of_machine(head), height_words(head.height), ground.grid_m)),
                 0.5 * ground.grid_m * ground.grid_m * static_cast<double>(ground.face.size()),
                 extent.high_m, extent.low_m);
  for (std::size_t n = 0; n < ground.point.size(); ++n) {
    const Eigen::Vector3d& at_m = ground.point[n].at_m;
    fmt::format_to(to, "<P id=\"{}\">{:.4f} {:.4f} {:.4f}</P>\n", n + 1, at_m.y(), at_m.x(),
                   at_m.z());
  }
  fmt::format_to(to, "</Pnts>\n<Faces>\n");
  for (const auto& face : ground.face) {
    fmt::format_to(to, "<F>{} {} {}</F>\n", face[0] + 1, face[1] + 1, face[2] + 1);
  }
  fmt::format_to(to, "</Faces>\n</Definition></Surface></Surfaces>\n</LandXML>\n");
  return fmt::to_string(text);
}

std::string points_text(const BuiltGround& ground, const BuiltHead& head) {
  const bool has_design =
      std::any_of(ground.point.begin(), ground.point.end(),
                  [](const BuiltPoint& point) { return std::isfinite(point.off_m); });
  fmt::memory_buffer text;
  auto to = std::back_inserter(text);
  // A line's end in a name would be a point.
  std::string what = fmt::format("{}: as built by {}; m, frame of the machine, z is the {}",
                                 head.project, of_machine(head), height_words(head.height));
  std::replace_if(
      what.begin(), what.end(), [](char letter) { return letter == '\n' || letter == '\r'; }, ' ');
  fmt::format_to(to, "# {}\nx,y,z,time,passes,lowest,newest{}\n", what, has_design ? ",off" : "");
  for (const BuiltPoint& point : ground.point) {
    fmt::format_to(to, "{:.4f},{:.4f},{:.4f},{},{},{:.4f},{:.4f}", point.at_m.x(), point.at_m.y(),
                   point.at_m.z(), utc_text(point.time_s, 2), point.passes, point.lowest_m,
                   point.newest_m);
    if (has_design) {
      fmt::format_to(to, ",{}",
                     std::isfinite(point.off_m) ? fmt::format("{:.4f}", point.off_m) : "");
    }
    fmt::format_to(to, "\n");
  }
  return fmt::to_string(text);
}

std::string ascii_text(const BuiltGround& ground) {
  const Extent extent = extent_of(ground);
  const auto columns = static_cast<std::size_t>(extent.last.i - extent.first.i) + 1;
  const auto rows = static_cast<std::size_t>(extent.last.j - extent.first.j) + 1;
  if (columns > kMostAscii / rows) {
    throw std::runtime_error(fmt::format(
        "--ascii: {} by {} cells from one end of the ground to the other; allowed: {} in all; a "
        "larger --grid makes fewer",
        columns, rows, kMostAscii));
  }
  fmt::memory_buffer text;
  auto to = std::back_inserter(text);
  fmt::format_to(to,
                 "ncols {}\nnrows {}\nxllcorner {:.4f}\nyllcorner {:.4f}\ncellsize {}\n"
                 "NODATA_value {}\n",
                 columns, rows, ground.grid_m * extent.first.i, ground.grid_m * extent.first.j,
                 ground.grid_m, kNoData);
  constexpr double kUnmade = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> row(columns);
  auto point = ground.point.rbegin();
  for (std::int32_t j = extent.last.j; j >= extent.first.j; --j) {
    std::fill(row.begin(), row.end(), kUnmade);
    for (; point != ground.point.rend() && point->cell.j == j; ++point) {
      row[static_cast<std::size_t>(point->cell.i - extent.first.i)] = point->at_m.z();
    }
    for (std::size_t i = 0; i < columns; ++i) {
      fmt::format_to(
          to, "{}{}", i == 0 ? "" : " ",
          std::isfinite(row[i]) ? fmt::format("{:.4f}", row[i]) : fmt::format("{}", kNoData));
    }
    fmt::format_to(to, "\n");
  }
  return fmt::to_string(text);
}

std::string ascii_head_text(const BuiltHead& head) {
  return fmt::format(
      "<PAMDataset>\n<Metadata>\n<MDI key=\"MACHINE\">{}</MDI>\n<MDI key=\"PROJECT\">{}</MDI>\n"
      "<MDI key=\"DATE_FROM\">{}</MDI>\n<MDI key=\"DATE_UNTIL\">{}</MDI>\n<MDI "
      "key=\"HEIGHT\">{}</MDI>\n<MDI key=\"UNIT\">metre</MDI>\n</Metadata>\n</PAMDataset>\n",
      escaped(head.machine), escaped(head.project), utc_text(head.from_s), utc_text(head.until_s),
      height_words(head.height));
}

std::string table_text(const BuiltGround& ground, const BuiltHead& head,
                       const std::optional<DesignFigures>& design) {
  const Extent extent = extent_of(ground);
  std::string text;
  const auto row = [&text](const char* name, const std::string& value) {
    text += fmt::format("{:<34}{}\n", name, value);
  };
  row("machine", head.machine);
  row("from, until", fmt::format("{}, {}", utc_text(head.from_s), utc_text(head.until_s)));
  if (!head.of_record) {
    row("way of the edge, at work", fmt::format("{:.1f} m, {:.1f} m", head.way_m, head.worked_m));
  }
  row("ground made", fmt::format("{:.2f} m2, {} cells of {} m", ground.area_m2(),
                                 ground.point.size(), ground.grid_m));
  row("height, lowest to highest", fmt::format("{:.3f} to {:.3f} m", extent.low_m, extent.high_m));
  const std::size_t fallen = fallen_in(ground);
  row("newest pass over the lowest",
      fmt::format("{} cells ({:.1f} %): soil has come there since, or the edge went through more",
                  fallen,
                  100.0 * static_cast<double>(fallen) / static_cast<double>(ground.point.size())));
  if (!design) {
    return text;
  }
  const auto millimetres = [](double value_m) { return fmt::format("{:+.1f} mm", 1e3 * value_m); };
  row("area on the design",
      fmt::format("{:.2f} m2; {:.2f} m2 lie outside of it", design->area_m2, design->outside_m2));
  row("off the design, RMS", fmt::format("{:.1f} mm", 1e3 * design->rms_m));
  row("  95 % within", fmt::format("{:.1f} mm", 1e3 * design->p95_m));
  row("  highest", millimetres(design->highest_m));
  row("  lowest", millimetres(design->lowest_m));
  row("  within tolerance", fmt::format("{:.1f} % within {:.0f} mm", 100.0 * design->within_ratio,
                                        1e3 * head.tolerance_m));
  row("over the design, to be cut", fmt::format("{:.3f} m3", design->cut_m3));
  row("under the design, to be filled", fmt::format("{:.3f} m3", design->fill_m3));
  return text;
}

}  // namespace graben::built
