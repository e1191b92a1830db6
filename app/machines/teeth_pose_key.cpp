#include "app/machines/teeth_pose_key.hpp"

namespace graben::machines {

TeethPose read_teeth(TomlReader& reader, const std::string& at) {
  const std::vector<double> position = reader.numbers(at + ".position", {-30.0, 30.0, "m"}, 3);
  return {{position[0], position[1], position[2]},
          reader.number(at + ".attitude", {-7.0, 7.0, "rad"})};
}

}  // namespace graben::machines
