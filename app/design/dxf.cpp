// SPDX-License-Identifier: Apache-2.0
/// Reads the 3DFACEs of a DXF of text. Beside them a drawing may have whatever it likes; what would
/// be ground too, but is no 3DFACE, is refused, as half a surface is none.

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>
#include <vector>

#include "app/design/dxf_groups.hpp"
#include "app/design/surface.hpp"
#include "app/machines/plain_text.hpp"

namespace graben::design {
namespace {

constexpr std::size_t kCorners = 4;
/// Of a face with four corners, between its two diagonals: more is another ground by the one than
/// by the other.
constexpr double kMostWarp_m = 2e-3;
/// Seen from above less is none: a face that stands upright, or a line.
constexpr double kLeastArea_m2 = 1e-9;

/// The groups of an entity that a surface needs.
struct Entity {
  std::string type;
  std::size_t line = 0;
  std::string layer = "0";  ///< As DXF has it where none is said.
  std::string name;         ///< Of a block.
  int flags = 0;
  bool is_on_paper = false;
  std::array<std::array<std::optional<double>, 3>, kCorners> corner{};

  [[nodiscard]] bool is_face() const { return type == "3DFACE"; }
  /// Ground in a form that is not read.
  [[nodiscard]] bool is_other_ground() const {
    constexpr int kMesh = 16;
    constexpr int kFaces = 64;
    return type == "MESH" || type == "3DSOLID" || type == "SURFACE" || type == "BODY" ||
           type == "AECC_TIN_SURFACE" || (type == "POLYLINE" && (flags & (kMesh | kFaces)) != 0);
  }
};

struct Block {
  std::set<std::string> ground_on;  ///< Layers.
  std::set<std::string> inserts;
};

double metres_of_code(int code) {
  static const std::map<int, double> known = {
      {1, 0.0254}, {2, 0.3048}, {4, 1e-3}, {5, 1e-2}, {6, 1.0}, {21, 1200.0 / 3937.0}, {14, 0.1}};
  const auto found = known.find(code);
  return found == known.end() ? 0.0 : found->second;
}

struct HashOfPoint {
  std::size_t operator()(const std::array<double, 3>& at) const {
    std::size_t hash = 0;
    for (const double value : at) {
      hash = hash * 1000003U + std::hash<double>()(value);
    }
    return hash;
  }
};

class DxfSurface {
 public:
  DxfSurface(const std::filesystem::path& file, const std::string& unit)
      : groups_(file), told_m_(unit.empty() ? 0.0 : metres_of_unit(unit)) {}

  Surface surface(const std::string& layer) {
    read();
    choose(layer);
    refuse_other_ground();
    find_unit();
    for (const Entity& face : face_) {
      if (face.layer == layer_) {
        add(face);
      }
    }
    if (surface_.face.empty()) {
      groups_.refuse(face_.front().line,
                     fmt::format("no 3DFACE of layer '{}' has an area seen from above", layer_));
    }
    return std::move(surface_);
  }

 private:
  void read() {
    Entity entity;
    bool ended = false;
    while (!ended && groups_.next()) {
      if (groups_.code() == 0) {
        finish(entity);
        entity = {};
        entity.type = groups_.value();
        entity.line = groups_.line();
        ended = entity.type == "EOF";
      } else {
        take(entity);
      }
    }
    if (!ended) {
      groups_.refuse(std::max<std::size_t>(groups_.line(), 1),
                     "ends without EOF: a part of the drawing is missing");
    }
  }

  void take(Entity& entity) {
    const int code = groups_.code();
    const std::string_view value = groups_.value();
    if (code == 8) {
      entity.layer = value;
    } else if (code == 2) {
      entity.name = value;
      // A header's variables are groups of its SECTION, some of code 2.
      if (entity.type == "SECTION" && section_.empty()) {
        section_ = value;
      }
    } else if (code == 9) {
      variable_ = value;
    } else if (code == 67) {
      entity.is_on_paper = value == "1";
    } else if (code == 70) {
      take_flags(entity, value);
    } else if (entity.is_face() && code >= 10 && code < 40 && code % 10 < 4) {
      const auto number = machines::number_in(value);
      if (!number) {
        groups_.refuse(groups_.line(), fmt::format("<3DFACE> group {}: {}; allowed: a number", code,
                                                   machines::not_a_number(value)));
      }
      entity.corner[static_cast<std::size_t>(code % 10)][static_cast<std::size_t>(code / 10 - 1)] =
          *number;
    }
  }

  void take_flags(Entity& entity, std::string_view value) {
    const auto number = machines::number_in(value);
    entity.flags = number && std::abs(*number) < 1e6 ? static_cast<int>(*number) : 0;
    if (section_ == "HEADER" && variable_ == "$INSUNITS") {
      unit_code_ = entity.flags;
      unit_line_ = groups_.line();
      variable_.clear();
    }
  }

  void finish(const Entity& entity) {
    if (entity.type == "ENDSEC") {
      section_.clear();
    } else if (section_ == "BLOCKS") {
      finish_in_block(entity);
    } else if (section_ == "ENTITIES" && entity.type != "SECTION" && !entity.is_on_paper) {
      ++count_[entity.type];
      if (entity.is_face()) {
        if (face_.size() >= kMostFaces) {
          groups_.refuse(entity.line, fmt::format("allowed: at most {} 3DFACEs", kMostFaces));
        }
        face_.push_back(entity);
      } else if (entity.is_other_ground() || entity.type == "INSERT") {
        other_.push_back(entity);
      }
    }
  }

  void finish_in_block(const Entity& entity) {
    if (entity.type == "BLOCK") {
      block_name_ = entity.name;
    } else if (entity.is_face() || entity.is_other_ground()) {
      block_[block_name_].ground_on.insert(entity.layer);
    } else if (entity.type == "INSERT") {
      block_[block_name_].inserts.insert(entity.name);
    }
  }

  void choose(const std::string& layer) {
    std::map<std::string, std::size_t> there;
    for (const Entity& face : face_) {
      ++there[face.layer];
    }
    std::string words;
    for (const auto& [name, count] : there) {
      words += fmt::format("{}'{}' ({})", words.empty() ? "" : ", ", name, count);
    }
    if (there.empty()) {
      std::string others;
      for (const auto& [type, count] : count_) {
        others += fmt::format("{}{} {}", others.empty() ? "" : ", ", count, type);
      }
      groups_.refuse(groups_.line(),
                     fmt::format("has no 3DFACE among its entities ({}); allowed: a surface as "
                                 "3DFACEs",
                                 others.empty() ? "there are none" : others));
    }
    if (layer.empty() ? there.size() > 1 : there.count(layer) == 0) {
      groups_.refuse(face_.front().line,
                     fmt::format("{}; allowed: one of the layers {} by --surface",
                                 layer.empty() ? "3DFACEs of several layers"
                                               : fmt::format("no 3DFACE on layer '{}'", layer),
                                 words));
    }
    layer_ = layer.empty() ? there.begin()->first : layer;
    is_told_ = !layer.empty();
  }

  /// An inserted block has ground on the layer; what lies on layer 0 there is on that of the
  /// INSERT.
  [[nodiscard]] bool has_ground(const std::string& name, const std::string& on, int depth) const {
    constexpr int kDeepest = 16;
    const auto found = block_.find(name);
    if (found == block_.end() || depth > kDeepest) {
      return false;
    }
    const Block& block = found->second;
    const bool here =
        !block.ground_on.empty() && (!is_told_ || block.ground_on.count(layer_) > 0 ||
                                     (block.ground_on.count("0") > 0 && on == layer_));
    return here ||
           std::any_of(block.inserts.begin(), block.inserts.end(),
                       [&](const std::string& inner) { return has_ground(inner, on, depth + 1); });
  }

  void refuse_other_ground() const {
    for (const Entity& entity : other_) {
      if (entity.type == "INSERT") {
        if (has_ground(entity.name, entity.layer, 0)) {
          groups_.refuse(entity.line,
                         fmt::format("<INSERT> of block '{}', which has faces; allowed: 3DFACEs in "
                                     "the drawing itself (explode it in CAD)",
                                     entity.name));
        }
      } else if (!is_told_ || entity.layer == layer_) {
        groups_.refuse(entity.line,
                       fmt::format("<{}> on layer '{}' beside the 3DFACEs of '{}'; allowed: "
                                   "3DFACEs alone, or their layer by --surface",
                                   entity.type, entity.layer, layer_));
      }
    }
  }

  /// What is told counts more than the file: CAD writes the unit of its template into that.
  void find_unit() {
    metres_ = told_m_ > 0.0 ? told_m_ : metres_of_code(unit_code_);
    if (metres_ <= 0.0) {
      groups_.refuse(unit_line_,
                     unit_code_ == 0
                         ? std::string("says no unit of length ($INSUNITS); allowed: --units")
                         : fmt::format("$INSUNITS {}; allowed: 1 (inch), 2 (foot), 4 (mm), 5 "
                                       "(cm), 6 (m), 14 (dm), 21 (US survey foot), or --units",
                                       unit_code_));
    }
  }

  Eigen::Vector3d corner_of(const Entity& face, std::size_t which) const {
    Eigen::Vector3d at_m;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto& value = face.corner[which][axis];
      if (!value) {
        groups_.refuse(face.line, fmt::format("<3DFACE> has no group {}; allowed: three corners "
                                              "and more, x, y and z each",
                                              10 * (axis + 1) + which));
      }
      const double most_m = axis == 2 ? kMostHeight_m : kMostPlan_m;
      const double value_m = *value * metres_;
      if (std::abs(value_m) > most_m) {
        groups_.refuse(face.line, fmt::format("<3DFACE> {} = {} m; allowed: {} .. {} m",
                                              "xyz"[axis], value_m, -most_m, most_m));
      }
      at_m[static_cast<int>(axis)] = value_m;
    }
    return at_m;
  }

  void add(const Entity& face) {
    std::array<Eigen::Vector3d, kCorners> at_m;
    for (std::size_t i = 0; i < 3; ++i) {
      at_m[i] = corner_of(face, i);
    }
    const auto& last = face.corner[3];
    const bool has_last = last[0] || last[1] || last[2];
    at_m[3] = has_last ? corner_of(face, 3) : at_m[2];
    const bool has_four = at_m[3] != at_m[2] && at_m[3] != at_m[0];
    if (has_four) {
      demand_flat(face, at_m);
    }
    add_triangle(at_m[0], at_m[1], at_m[2]);
    if (has_four) {
      add_triangle(at_m[0], at_m[2], at_m[3]);
    }
  }

  void demand_flat(const Entity& face, const std::array<Eigen::Vector3d, kCorners>& at_m) const {
    const Eigen::Vector3d up = (at_m[2] - at_m[0]).cross(at_m[3] - at_m[1]);
    if (up.norm() < kLeastArea_m2) {
      return;
    }
    const double warp_m = std::abs(up.normalized().dot(at_m[1] - at_m[0]));
    if (warp_m > kMostWarp_m) {
      groups_.refuse(face.line,
                     fmt::format("<3DFACE> of four corners, whose diagonals pass {:.4f} m apart; "
                                 "allowed: {} m, or triangles",
                                 warp_m, kMostWarp_m));
    }
  }

  void add_triangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
    if (std::abs((b - a).cross(c - a).z()) > kLeastArea_m2) {
      surface_.face.push_back({index_of(a), index_of(b), index_of(c)});
    }
  }

  std::uint32_t index_of(const Eigen::Vector3d& at_m) {
    const auto next = static_cast<std::uint32_t>(surface_.point_m.size());
    const auto [there, is_new] = index_.try_emplace({at_m.x(), at_m.y(), at_m.z()}, next);
    if (is_new) {
      surface_.point_m.push_back(at_m);
    }
    return there->second;
  }

  DxfGroups groups_;
  double told_m_;
  double metres_ = 0.0;
  int unit_code_ = 0;
  std::size_t unit_line_ = 1;
  std::string variable_;
  std::string section_;
  std::string block_name_;
  std::string layer_;
  bool is_told_ = false;
  std::vector<Entity> face_;
  std::vector<Entity> other_;  ///< Ground of other forms, and blocks that are inserted.
  std::map<std::string, std::size_t> count_;
  std::map<std::string, Block> block_;
  std::unordered_map<std::array<double, 3>, std::uint32_t, HashOfPoint> index_;
  Surface surface_;
};

}  // namespace

Surface read_dxf(const std::filesystem::path& file, const std::string& layer,
                 const std::string& unit) {
  return DxfSurface(file, unit).surface(layer);
}

}  // namespace graben::design
