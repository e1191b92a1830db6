int first_value();

int refused() {
  static const int kept = first_value();
  return kept;
}

int first_value() { return 1; }
