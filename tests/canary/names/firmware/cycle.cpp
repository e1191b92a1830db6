#include "firmware/cycle.hpp"

std::uint8_t kept;  // comes with its header; std::string is only spoken of
std::array<int, 2> pair;
std::size_t count;
Eigen::Vector3d at;
const auto across = at.cross(at);
std::bitset<8> bits;
