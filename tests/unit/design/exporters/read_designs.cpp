// SPDX-License-Identifier: Apache-2.0
/// Reads LandXML surfaces for check_exporters.py: a line "FILE<tab>SURFACE" each on standard input.
/// Of each it prints the points of its faces, x y z in m, nine numbers a line, or why it is
/// refused, then an empty line.

#include <cstdio>
#include <exception>
#include <iostream>
#include <string>

#include "app/design/surface.hpp"

int main() {
  using namespace graben::design;
  for (std::string line; std::getline(std::cin, line);) {
    const std::size_t tab = line.find('\t');
    try {
      const Surface surface = read_landxml(line.substr(0, tab), line.substr(tab + 1));
      for (const auto& face : surface.face) {
        for (const std::uint32_t corner : face) {
          const Eigen::Vector3d& at_m = surface.point_m[corner];
          std::printf("%.9g %.9g %.9g ", at_m.x(), at_m.y(), at_m.z());
        }
        std::puts("");
      }
    } catch (const std::exception& error) {
      std::string said = error.what();
      for (char& letter : said) {
        letter = letter == '\n' ? ' ' : letter;
      }
      std::printf("refused %s\n", said.c_str());
    }
    std::puts("");
  }
  return 0;
}
