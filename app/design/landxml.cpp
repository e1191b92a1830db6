// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <pugixml.hpp>
#include <string_view>
#include <unordered_map>

#include "app/design/surface.hpp"
#include "app/machines/number_lines.hpp"
#include "app/machines/profile_file.hpp"

namespace graben::design {
namespace {

using machines::ProfileError;

constexpr std::size_t kMostErrors = 10;
constexpr std::string_view kBlank = " \t\r\n";

/// The words of an element, between blanks; one more than `most` ends it.
std::vector<std::string_view> words_of(const char* text, std::size_t most) {
  std::vector<std::string_view> words;
  std::string_view rest(text);
  while (words.size() <= most) {
    rest.remove_prefix(std::min(rest.find_first_not_of(kBlank), rest.size()));
    if (rest.empty()) {
      break;
    }
    words.push_back(rest.substr(0, rest.find_first_of(kBlank)));
    rest.remove_prefix(words.back().size());
  }
  return words;
}

template <class Number>
std::optional<Number> number_of(std::string_view word) {
  Number number{};
  const char* const end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, number);
  return error == std::errc() && stop == end ? std::optional<Number>(number) : std::nullopt;
}

/// Metres of the file's unit of length, by the words of LandXML's schema.
double metres_of(const std::string& unit) {
  constexpr double kFoot = 0.3048;
  static const std::unordered_map<std::string, double> known = {
      {"meter", 1.0},         {"millimeter", 1e-3},    {"centimeter", 1e-2},
      {"kilometer", 1e3},     {"foot", kFoot},         {"USSurveyFoot", 1200.0 / 3937.0},
      {"inch", kFoot / 12.0}, {"mile", 5280.0 * kFoot}};
  const auto found = known.find(unit);
  return found != known.end() ? found->second : 0.0;
}

class LandXml {
 public:
  explicit LandXml(const std::filesystem::path& file)
      : file_(file), text_(machines::file_text(file, "a design in LandXML")) {
    const pugi::xml_parse_result parsed = document_.load_buffer(text_.data(), text_.size());
    if (!parsed) {
      throw ProfileError(file.string(),
                         {fmt::format("line {}: can't be read as XML: {}", line_at(parsed.offset),
                                      parsed.description())});
    }
  }

  Surface surface(const std::string& name) {
    const pugi::xml_node root = document_.document_element();
    if (std::string_view(root.name()) != "LandXML") {
      refuse(root, "allowed: LandXML as the outermost element");
    }
    read_unit(root);
    const pugi::xml_node definition = definition_of(chosen(root, name));
    read_points(definition);
    read_faces(definition);
    throw_errors();
    if (surface_.face.empty()) {
      refuse(definition, "has no face; allowed: 1 and more");
    }
    return std::move(surface_);
  }

 private:
  [[nodiscard]] std::size_t line_at(std::ptrdiff_t offset) const {
    const auto end = text_.begin() + std::clamp<std::ptrdiff_t>(
                                         offset, 0, static_cast<std::ptrdiff_t>(text_.size()));
    return 1 + static_cast<std::size_t>(std::count(text_.begin(), end, '\n'));
  }
  /// "line 12, <P id="7">"
  [[nodiscard]] std::string place(const pugi::xml_node& node) const {
    std::string mark;
    for (const char* name : {"name", "id"}) {
      if (const pugi::xml_attribute attribute = node.attribute(name)) {
        mark = fmt::format(" {}=\"{}\"", name, attribute.value());
        break;
      }
    }
    return fmt::format("line {}, <{}{}>", line_at(node.offset_debug()), node.name(), mark);
  }
  void note(const pugi::xml_node& node, const std::string& what) {
    errors_.push_back(fmt::format("{}: {}", place(node), what));
    if (errors_.size() >= kMostErrors) {
      throw_errors();
    }
  }
  [[noreturn]] void refuse(const pugi::xml_node& node, const std::string& what) const {
    throw ProfileError(file_.string(), {fmt::format("{}: {}", place(node), what)});
  }
  void throw_errors() const {
    if (!errors_.empty()) {
      throw ProfileError(file_.string(), errors_);
    }
  }

  void read_unit(const pugi::xml_node& root) {
    const pugi::xml_node units = root.child("Units");
    const pugi::xml_node system = units.find_child([](const pugi::xml_node&) { return true; });
    if (!system) {
      refuse(units ? units : root,
             "says no unit of length; allowed: <Units> with <Metric> or <Imperial>, linearUnit");
    }
    metres_ = metres_of(system.attribute("linearUnit").value());
    if (metres_ <= 0.0) {
      refuse(system, fmt::format("linearUnit=\"{}\"; allowed: meter, millimeter, centimeter, "
                                 "kilometer, foot, USSurveyFoot, inch, mile",
                                 system.attribute("linearUnit").value()));
    }
  }

  [[nodiscard]] pugi::xml_node chosen(const pugi::xml_node& root, const std::string& name) const {
    const pugi::xml_node surfaces = root.child("Surfaces");
    std::string there;
    pugi::xml_node found;
    int count = 0;
    for (const pugi::xml_node& surface : surfaces.children("Surface")) {
      const std::string own = surface.attribute("name").value();
      there += (there.empty() ? "" : ", ") + ("'" + own + "'");
      if (name.empty() || own == name) {
        found = surface;
        ++count;
      }
    }
    if (count == 1) {
      return found;
    }
    if (there.empty()) {
      refuse(surfaces ? surfaces : root, "has no <Surface>; allowed: <Surfaces> with 1 and more");
    }
    refuse(surfaces, name.empty()
                         ? fmt::format("allowed: one of {}, by --surface", there)
                         : fmt::format("surface '{}' is there {} times; allowed: one of {}", name,
                                       count, there));
  }

  [[nodiscard]] pugi::xml_node definition_of(const pugi::xml_node& surface) const {
    const pugi::xml_node definition = surface.child("Definition");
    if (!definition) {
      refuse(surface, "has no <Definition>; allowed: surfType=\"TIN\"");
    }
    const std::string_view type = definition.attribute("surfType").value();
    if (type != "TIN") {
      refuse(definition, fmt::format("surfType=\"{}\"; allowed: TIN", type));
    }
    return definition;
  }

  void read_points(const pugi::xml_node& definition) {
    const pugi::xml_node points = definition.child("Pnts");
    if (!points) {
      refuse(definition, "has no <Pnts>");
    }
    for (const pugi::xml_node& node : points.children("P")) {
      if (surface_.point_m.size() >= kMostPoints) {
        refuse(node, fmt::format("allowed: at most {} points", kMostPoints));
      }
      const auto id = number_of<std::uint64_t>(node.attribute("id").value());
      if (!id) {
        note(node, "allowed: a whole number as its id");
        continue;
      }
      if (!index_.emplace(*id, static_cast<std::uint32_t>(surface_.point_m.size())).second) {
        note(node, "its id is there for the second time");
      }
      surface_.point_m.push_back(point_of(node));
    }
  }

  /// LandXML's order is north, east, height.
  Eigen::Vector3d point_of(const pugi::xml_node& node) {
    const auto words = words_of(node.child_value(), 3);
    Eigen::Vector3d north_east_up_m = Eigen::Vector3d::Zero();
    if (words.size() != 3) {
      note(node, fmt::format("{} numbers; allowed: 3, north, east and height",
                             words.size() > 3 ? "more than 3" : std::to_string(words.size())));
      return north_east_up_m;
    }
    for (unsigned i = 0; i < 3; ++i) {
      const double most_m = i == 2 ? kMostHeight_m : kMostPlan_m;
      const auto number = number_of<double>(words[i]);
      const double value_m = number.value_or(std::nan("")) * metres_;
      if (!(std::abs(value_m) <= most_m)) {
        note(node, fmt::format("'{}' as its {}; allowed: {} .. {} m", words[i],
                               i == 0 ? "north" : (i == 1 ? "east" : "height"), -most_m, most_m));
        return Eigen::Vector3d::Zero();
      }
      north_east_up_m[i] = value_m;
    }
    return {north_east_up_m.y(), north_east_up_m.x(), north_east_up_m.z()};
  }

  void read_faces(const pugi::xml_node& definition) {
    for (const pugi::xml_node& faces : definition.children("Faces")) {
      for (const pugi::xml_node& node : faces.children("F")) {
        if (surface_.face.size() >= kMostFaces) {
          refuse(node, fmt::format("allowed: at most {} faces", kMostFaces));
        }
        if (!node.attribute("i").as_bool()) {
          read_face(node);
        }
      }
    }
  }

  void read_face(const pugi::xml_node& node) {
    const auto words = words_of(node.child_value(), 3);
    if (words.size() != 3) {
      note(node, fmt::format("{} points; allowed: 3, by their ids",
                             words.size() > 3 ? "more than 3" : std::to_string(words.size())));
      return;
    }
    std::array<std::uint32_t, 3> face{};
    for (unsigned i = 0; i < 3; ++i) {
      const auto id = number_of<std::uint64_t>(words[i]);
      const auto found = id ? index_.find(*id) : index_.end();
      if (found == index_.end()) {
        note(node, fmt::format("point '{}' is not there; allowed: the ids of <P>", words[i]));
        return;
      }
      face[i] = found->second;
    }
    surface_.face.push_back(face);
  }

  std::filesystem::path file_;
  std::string text_;
  pugi::xml_document document_;
  double metres_ = 1.0;
  std::unordered_map<std::uint64_t, std::uint32_t> index_;
  Surface surface_;
  std::vector<std::string> errors_;
};

}  // namespace

Surface read_landxml(const std::filesystem::path& file, const std::string& name) {
  return LandXml(file).surface(name);
}

}  // namespace graben::design
