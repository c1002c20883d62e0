// Preloaded into a process: the computer's clock jumps by the seconds that the file $CLOCK_OFFSET
// holds. A wait that has begun keeps its end, as if the clock had jumped before or after it.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdint.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <time.h>

typedef int (*gettime)(clockid_t, struct timespec*);
typedef int (*timedwait)(pthread_cond_t*, pthread_mutex_t*, const struct timespec*);

static volatile const int64_t* offset;
static gettime real_gettime;
static timedwait real_timedwait;

__attribute__((constructor)) static void attach(void) {
  int file = open(getenv("CLOCK_OFFSET"), O_RDONLY);
  offset = mmap(NULL, sizeof *offset, PROT_READ, MAP_SHARED, file, 0);
  real_gettime = (gettime)dlsym(RTLD_NEXT, "clock_gettime");
  real_timedwait = (timedwait)dlvsym(RTLD_NEXT, "pthread_cond_timedwait", "GLIBC_2.3.2");
}

int clock_gettime(clockid_t clock, struct timespec* now) {
  int result = real_gettime(clock, now);
  if (clock == CLOCK_REALTIME && result == 0) now->tv_sec += *offset;
  return result;
}

int pthread_cond_timedwait(pthread_cond_t* cond, pthread_mutex_t* mutex,
                           const struct timespec* deadline) {
  struct timespec real = *deadline;
  if (real.tv_sec > 500000000)  // a deadline of the steady clock is the computer's uptime
    real.tv_sec -= *offset;
  return real_timedwait(cond, mutex, &real);
}
