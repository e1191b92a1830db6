int limited(int value) { return value > 10 ? 10 : value; }
