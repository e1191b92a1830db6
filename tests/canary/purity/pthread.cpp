// Declared here: a target without threads has no header for it.
extern "C" int pthread_create(void* thread, const void* attributes, void* (*work)(void*), void*);

int refused(void* thread, void* (*work)(void*)) {
  return pthread_create(thread, nullptr, work, nullptr);
}
