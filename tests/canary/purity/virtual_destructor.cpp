struct Port {
  virtual ~Port();
};

Port::~Port() = default;
