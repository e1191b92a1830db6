#include <pthread.h>

int refused(pthread_t* thread, void* (*work)(void*)) {
  return pthread_create(thread, nullptr, work, nullptr);
}
