#include "firmware/cycle.hpp"

std::uint8_t kept;  // comes with its header; std::string is only spoken of
constexpr auto kText = "// std::list<int>"; std::array<int, 2> pair;
std::size_t count;
Eigen::Vector3d at;
/* #include <algorithm>
   */
const double least = std ::min(1.0, 2.0);
std::bitset<8> bits;
size_t bare;
using namespace std;
