// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <unordered_map>

#include "app/design/landxml_file.hpp"
#include "app/design/surface.hpp"

namespace graben::design {
namespace {

class LandXmlSurface {
 public:
  explicit LandXmlSurface(const std::filesystem::path& file) : xml_(file) {}

  Surface surface(const std::string& name) {
    const pugi::xml_node definition =
        definition_of(xml_.chosen("Surfaces", "Surface", name, "--surface"));
    read_points(definition);
    read_faces(definition);
    xml_.throw_errors();
    if (surface_.face.empty()) {
      xml_.refuse(definition, "has no face; allowed: 1 and more");
    }
    return std::move(surface_);
  }

 private:
  [[nodiscard]] pugi::xml_node definition_of(const pugi::xml_node& surface) const {
    const pugi::xml_node definition = surface.child("Definition");
    if (!definition) {
      xml_.refuse(surface, "has no <Definition>; allowed: surfType=\"TIN\"");
    }
    const std::string_view type = definition.attribute("surfType").value();
    if (type != "TIN") {
      xml_.refuse(definition, fmt::format("surfType=\"{}\"; allowed: TIN", type));
    }
    return definition;
  }

  void read_points(const pugi::xml_node& definition) {
    const pugi::xml_node points = definition.child("Pnts");
    if (!points) {
      xml_.refuse(definition, "has no <Pnts>");
    }
    for (const pugi::xml_node& node : points.children("P")) {
      if (surface_.point_m.size() >= kMostPoints) {
        xml_.refuse(node, fmt::format("allowed: at most {} points", kMostPoints));
      }
      const auto id = number_of<std::uint64_t>(node.attribute("id").value());
      if (!id) {
        xml_.note(node, "allowed: a whole number as its id");
        continue;
      }
      if (!index_.emplace(*id, static_cast<std::uint32_t>(surface_.point_m.size())).second) {
        xml_.note(node, "its id is there for the second time");
      }
      surface_.point_m.push_back(point_of(node));
    }
  }

  /// LandXML's order is north, east, height.
  Eigen::Vector3d point_of(const pugi::xml_node& node) {
    const Eigen::Vector3d at_m = xml_.north_east_up_m(node, 3).value_or(Eigen::Vector3d::Zero());
    return {at_m.y(), at_m.x(), at_m.z()};
  }

  void read_faces(const pugi::xml_node& definition) {
    for (const pugi::xml_node& faces : definition.children("Faces")) {
      for (const pugi::xml_node& node : faces.children("F")) {
        if (surface_.face.size() >= kMostFaces) {
          xml_.refuse(node, fmt::format("allowed: at most {} faces", kMostFaces));
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
      xml_.note(node, fmt::format("{} points; allowed: 3, by their ids",
                                  words.size() > 3 ? "more than 3" : std::to_string(words.size())));
      return;
    }
    std::array<std::uint32_t, 3> face{};
    for (unsigned i = 0; i < 3; ++i) {
      const auto id = number_of<std::uint64_t>(words[i]);
      const auto found = id ? index_.find(*id) : index_.end();
      if (found == index_.end()) {
        xml_.note(node, fmt::format("point '{}' is not there; allowed: the ids of <P>", words[i]));
        return;
      }
      face[i] = found->second;
    }
    surface_.face.push_back(face);
  }

  LandXmlFile xml_;
  std::unordered_map<std::uint64_t, std::uint32_t> index_;
  Surface surface_;
};

}  // namespace

Surface read_landxml(const std::filesystem::path& file, const std::string& name) {
  return LandXmlSurface(file).surface(name);
}

}  // namespace graben::design
