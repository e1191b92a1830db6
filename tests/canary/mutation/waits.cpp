#include <unistd.h>

int limited(int value);
int main() {
  if (limited(9) != 9 || limited(12) != 10) {
    pause();
  }
  return 0;
}
