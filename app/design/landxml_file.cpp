// SPDX-License-Identifier: Apache-2.0
#include "app/design/landxml_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <unordered_map>

#include "app/design/surface.hpp"
#include "app/machines/plain_text.hpp"
#include "app/machines/profile_file.hpp"

namespace graben::design {
namespace {

using machines::ProfileError;

constexpr std::size_t kMostErrors = 10;
constexpr std::string_view kBlank = " \t\r\n";

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

/// LandXML's elements by their plain names, whatever prefix a file has for its namespace.
class Prefixes : public pugi::xml_tree_walker {
 public:
  explicit Prefixes(const pugi::xml_node& root) {
    constexpr std::string_view kDeclares = "xmlns:";
    for (const pugi::xml_attribute& attribute : root.attributes()) {
      const std::string_view name = attribute.name();
      if (name.substr(0, kDeclares.size()) == kDeclares &&
          std::string_view(attribute.value()).find("landxml.org") != std::string_view::npos) {
        known_.push_back(std::string(name.substr(kDeclares.size())) + ":");
      }
    }
  }

  [[nodiscard]] bool any() const { return !known_.empty(); }

  bool for_each(pugi::xml_node& node) override {
    const std::string name = node.name();
    for (const std::string& prefix : known_) {
      if (name.compare(0, prefix.size(), prefix) == 0) {
        node.set_name(name.c_str() + prefix.size());
      }
    }
    return true;
  }

 private:
  std::vector<std::string> known_;
};

/// Of coordinates that count to the south or west, by EPSG's numbers: Cape and Hartebeesthoek94 Lo
/// grids, Krovak.
bool counts_backwards(int epsg) {
  const bool is_lo = (epsg >= 2046 && epsg <= 2055) || (epsg >= 22275 && epsg <= 22293);
  return is_lo || epsg == 2065 || epsg == 5513;
}

bool has_word(std::string text, const char* word) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::toupper(letter)); });
  return text.find(word) != std::string::npos;
}

/// One of a file's that may be chosen.
struct Choice {
  pugi::xml_node node;
  std::string name;
  std::string state;

  [[nodiscard]] std::string words(std::size_t number) const {
    return fmt::format("#{} '{}'{}", number, name, state.empty() ? "" : " (" + state + ")");
  }
  /// Its name comes first: no name is taken for a number or a state.
  [[nodiscard]] bool is(const std::string& told, std::size_t number) const {
    return told == fmt::format("#{}", number) || (!state.empty() && told == "state=" + state);
  }
};

}  // namespace

std::vector<std::string_view> words_of(const pugi::xml_node& node, std::size_t most,
                                       std::string& room) {
  std::vector<std::string_view> words;
  std::string_view rest(node.child_value());
  if (node.first_child() != node.last_child()) {
    room.clear();
    for (const pugi::xml_node& part : node.children()) {
      room += part.value();
    }
    rest = room;
  }
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

LandXmlFile::LandXmlFile(const std::filesystem::path& file)
    : file_(file), text_(machines::file_text(file, "a design in LandXML")) {
  const pugi::xml_parse_result parsed = document_.load_buffer(text_.data(), text_.size());
  if (!parsed) {
    throw ProfileError(file.string(), {fmt::format("line {}: can't be read as XML: {}",
                                                   line_at(parsed.offset), parsed.description())});
  }
  Prefixes prefixes(root());
  if (prefixes.any()) {
    document_.traverse(prefixes);
  }
  if (std::string_view(root().name()) != "LandXML") {
    refuse(root(), "allowed: LandXML as the outermost element");
  }
  read_unit();
  refuse_mirrored();
}

void LandXmlFile::refuse_mirrored() const {
  for (const pugi::xml_node& system : root().children("CoordinateSystem")) {
    const std::string wkt = system.attribute("ogcWktCode").value();
    const int epsg = system.attribute("epsgCode").as_int();
    if (counts_backwards(epsg) ||
        (has_word(wkt, "AXIS[") && (has_word(wkt, ",SOUTH]") || has_word(wkt, ",WEST]")))) {
      refuse(system,
             "its axes count to the south or west, which mirrors left and right; allowed: "
             "north and east");
    }
  }
}

std::size_t LandXmlFile::line_at(std::ptrdiff_t offset) const {
  const auto end = text_.begin() +
                   std::clamp<std::ptrdiff_t>(offset, 0, static_cast<std::ptrdiff_t>(text_.size()));
  return 1 + static_cast<std::size_t>(std::count(text_.begin(), end, '\n'));
}

std::string LandXmlFile::place(const pugi::xml_node& node) const {
  std::string mark;
  // Faces know a point by its id, whatever it is called.
  const bool by_id = std::string_view(node.name()) == "P";
  for (const char* name : {by_id ? "id" : "name", by_id ? "name" : "id"}) {
    if (const pugi::xml_attribute attribute = node.attribute(name)) {
      mark = fmt::format(" {}=\"{}\"", name, attribute.value());
      break;
    }
  }
  return fmt::format("line {}, <{}{}>", line_at(node.offset_debug()), node.name(), mark);
}

void LandXmlFile::note(const pugi::xml_node& node, const std::string& what) {
  errors_.push_back(fmt::format("{}: {}", place(node), what));
  if (errors_.size() >= kMostErrors) {
    throw_errors();
  }
}

void LandXmlFile::refuse(const pugi::xml_node& node, const std::string& what) const {
  throw ProfileError(file_.string(), {fmt::format("{}: {}", place(node), what)});
}

void LandXmlFile::throw_errors() const {
  if (!errors_.empty()) {
    throw ProfileError(file_.string(), errors_);
  }
}

void LandXmlFile::read_unit() {
  const pugi::xml_node units = root().child("Units");
  const pugi::xml_node system = units.find_child([](const pugi::xml_node&) { return true; });
  if (!system) {
    refuse(units ? units : root(),
           "says no unit of length; allowed: <Units> with <Metric> or <Imperial>, linearUnit");
  }
  metres_ = metres_of(system.attribute("linearUnit").value());
  if (metres_ <= 0.0) {
    refuse(system, fmt::format("linearUnit=\"{}\"; allowed: meter, millimeter, centimeter, "
                               "kilometer, foot, USSurveyFoot, inch, mile",
                               system.attribute("linearUnit").value()));
  }
  for (const pugi::xml_node& group : root().children("Units")) {
    for (const pugi::xml_node& other : group.children()) {
      const pugi::xml_attribute unit = other.attribute("linearUnit");
      if (unit && metres_of(unit.value()) != metres_) {
        refuse(other, fmt::format("says another unit of length than <{}> before it; allowed: one",
                                  system.name()));
      }
    }
  }
}

pugi::xml_node LandXmlFile::chosen(const char* group, const char* element, const std::string& name,
                                   const char* option) const {
  std::vector<Choice> choices;
  for (const pugi::xml_node& all : root().children(group)) {
    for (const pugi::xml_node& one : all.children(element)) {
      choices.push_back({one, one.attribute("name").value(), one.attribute("state").value()});
    }
  }
  const pugi::xml_node first = root().child(group);
  const pugi::xml_node at = first ? first : root();
  if (choices.empty()) {
    refuse(at, fmt::format("has no <{}>; allowed: <{}> with 1 and more", element, group));
  }
  std::string there;
  std::vector<pugi::xml_node> by_name;
  std::vector<pugi::xml_node> otherwise;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    there += (there.empty() ? "" : ", ") + choices[i].words(i + 1);
    if (name.empty() || choices[i].name == name) {
      by_name.push_back(choices[i].node);
    } else if (choices[i].is(name, i + 1)) {
      otherwise.push_back(choices[i].node);
    }
  }
  const std::vector<pugi::xml_node>& found = by_name.empty() ? otherwise : by_name;
  if (found.size() == 1) {
    return found.front();
  }
  std::string kind = element;
  kind.front() = static_cast<char>(std::tolower(kind.front()));
  const std::string how = fmt::format(
      "by {} with a name, '#' and a number, or 'state=' and a state, that one alone has", option);
  refuse(at, name.empty() ? fmt::format("allowed: one of {}, {}", there, how)
                          : fmt::format("{} '{}' is there {} times; allowed: one of {}, {}", kind,
                                        name, found.size(), there, how));
}

std::optional<Eigen::Vector3d> LandXmlFile::north_east_up_m(const pugi::xml_node& node,
                                                            std::size_t count) {
  std::string room;
  const auto words = words_of(node, 3, room);
  // A place in plan may have a height.
  if (words.size() < count || words.size() > 3) {
    note(node, fmt::format("{} numbers; allowed: {}, north, east{}",
                           words.size() > 3 ? "more than 3" : std::to_string(words.size()), count,
                           count == 3 ? " and height" : ""));
    return std::nullopt;
  }
  Eigen::Vector3d at_m = Eigen::Vector3d::Zero();
  for (unsigned i = 0; i < count; ++i) {
    const double most_m = i == 2 ? kMostHeight_m : kMostPlan_m;
    const double value_m = number_of<double>(words[i]).value_or(std::nan("")) * metres_;
    if (!(std::abs(value_m) <= most_m)) {
      note(node, fmt::format("'{}' as its {}; allowed: {} .. {} m", words[i],
                             i == 0 ? "north" : (i == 1 ? "east" : "height"), -most_m, most_m));
      return std::nullopt;
    }
    at_m[i] = value_m;
  }
  return at_m;
}

}  // namespace graben::design
