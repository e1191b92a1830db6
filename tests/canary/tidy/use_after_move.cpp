#include <string>
#include <utility>

std::string twice(std::string text) {
  std::string moved = std::move(text);
  return moved + text;
}
