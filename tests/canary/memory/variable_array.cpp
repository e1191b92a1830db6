/// An array as long as it is asked to be.

namespace {

[[gnu::noinline]] int last(int count) {
  volatile int values[count];
  values[count - 1] = count;
  return values[count - 1];
}

}  // namespace

int main(int argc, char**) { return last(argc); }
