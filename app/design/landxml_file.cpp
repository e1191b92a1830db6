// SPDX-License-Identifier: Apache-2.0
#include "app/design/landxml_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <unordered_map>

#include "app/design/surface.hpp"
#include "app/machines/number_lines.hpp"
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

}  // namespace

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

LandXmlFile::LandXmlFile(const std::filesystem::path& file)
    : file_(file), text_(machines::file_text(file, "a design in LandXML")) {
  const pugi::xml_parse_result parsed = document_.load_buffer(text_.data(), text_.size());
  if (!parsed) {
    throw ProfileError(file.string(), {fmt::format("line {}: can't be read as XML: {}",
                                                   line_at(parsed.offset), parsed.description())});
  }
  if (std::string_view(root().name()) != "LandXML") {
    refuse(root(), "allowed: LandXML as the outermost element");
  }
  read_unit();
}

std::size_t LandXmlFile::line_at(std::ptrdiff_t offset) const {
  const auto end = text_.begin() +
                   std::clamp<std::ptrdiff_t>(offset, 0, static_cast<std::ptrdiff_t>(text_.size()));
  return 1 + static_cast<std::size_t>(std::count(text_.begin(), end, '\n'));
}

std::string LandXmlFile::place(const pugi::xml_node& node) const {
  std::string mark;
  for (const char* name : {"name", "id"}) {
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
}

pugi::xml_node LandXmlFile::chosen(const char* group, const char* element, const std::string& name,
                                   const char* option) const {
  const pugi::xml_node all = root().child(group);
  std::string there;
  pugi::xml_node found;
  int count = 0;
  for (const pugi::xml_node& one : all.children(element)) {
    const std::string own = one.attribute("name").value();
    there += (there.empty() ? "" : ", ") + ("'" + own + "'");
    if (name.empty() || own == name) {
      found = one;
      ++count;
    }
  }
  if (count == 1) {
    return found;
  }
  if (there.empty()) {
    refuse(all ? all : root(),
           fmt::format("has no <{}>; allowed: <{}> with 1 and more", element, group));
  }
  std::string kind = element;
  kind.front() = static_cast<char>(std::tolower(kind.front()));
  refuse(all, name.empty() ? fmt::format("allowed: one of {}, by {}", there, option)
                           : fmt::format("{} '{}' is there {} times; allowed: one of {}", kind,
                                         name, count, there));
}

std::optional<Eigen::Vector3d> LandXmlFile::north_east_up_m(const pugi::xml_node& node,
                                                            std::size_t count) {
  const auto words = words_of(node.child_value(), 3);
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
