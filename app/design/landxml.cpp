// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <unordered_map>
#include <vector>

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
    take_points();
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
    if (const pugi::xml_node second = definition.next_sibling("Definition")) {
      xml_.refuse(second, "is the surface's second one; allowed: one");
    }
    const std::string_view type = definition.attribute("surfType").value();
    if (type != "TIN") {
      xml_.refuse(definition, fmt::format("surfType=\"{}\"; allowed: TIN", type));
    }
    return definition;
  }

  void read_points(const pugi::xml_node& definition) {
    if (!definition.child("Pnts")) {
      xml_.refuse(definition, "has no <Pnts>");
    }
    for (const pugi::xml_node& points : definition.children("Pnts")) {
      for (const pugi::xml_node& node : points.children("P")) {
        if (point_.size() >= kMostPoints) {
          xml_.refuse(node, fmt::format("allowed: at most {} points", kMostPoints));
        }
        // Of no use without an id that a face can name.
        if (const auto id = number_of<std::uint64_t>(node.attribute("id").value())) {
          const auto at = static_cast<std::uint32_t>(point_.size());
          const bool is_new = index_.emplace(*id, at).second;
          point_.push_back({node, is_new ? at : index_[*id]});
        }
      }
    }
  }

  /// What a face uses is judged, and nothing else: files have points outside every face, for frames
  /// and breaklines, that are none.
  void use(std::uint32_t at) {
    if (is_used_.empty()) {
      is_used_.resize(point_.size());
    }
    is_used_[at] = true;
  }

  /// The points that faces use, in the file's order.
  void take_points() {
    std::vector<std::uint32_t> place(point_.size());
    for (std::uint32_t at = 0; at < point_.size(); ++at) {
      const Point& point = point_[at];
      if (point.first == at && !is_used_.empty() && is_used_[at]) {
        place[at] = static_cast<std::uint32_t>(surface_.point_m.size());
        surface_.point_m.push_back(point_of(point.node));
      } else if (point.first != at && !is_used_.empty() && is_used_[point.first]) {
        demand_same(point.node, point_of(point.node), surface_.point_m[place[point.first]]);
      }
    }
    for (auto& face : surface_.face) {
      for (std::uint32_t& corner : face) {
        corner = place[corner];
      }
    }
  }

  void demand_same(const pugi::xml_node& node, const Eigen::Vector3d& at_m,
                   const Eigen::Vector3d& first_m) {
    if (at_m != first_m) {
      xml_.note(node, "its id is there for the second time, elsewhere");
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
    std::string room;
    const auto words = words_of(node, 3, room);
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
    for (const std::uint32_t corner : face) {
      use(corner);
    }
    surface_.face.push_back(face);
  }

  struct Point {
    pugi::xml_node node;
    std::uint32_t first = 0;  ///< Of this id, its own place unless it was there before.
  };

  LandXmlFile xml_;
  std::unordered_map<std::uint64_t, std::uint32_t> index_;
  std::vector<Point> point_;
  std::vector<bool> is_used_;  ///< By a face; none: there is none.
  Surface surface_;
};

}  // namespace

Surface read_landxml(const std::filesystem::path& file, const std::string& name) {
  return LandXmlSurface(file).surface(name);
}

}  // namespace graben::design
