/// A pointer that may lead anywhere.

namespace {
using Any = int (*)(int);
volatile Any any = nullptr;
}  // namespace

int main(int argc, char**) { return any(argc) + 1; }
