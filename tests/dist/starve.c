/* Loaded before all else: counts the threads that are asked for, and lets some of them fail as a system does that has no
   more. STARVE_FIRST and STARVE_LAST say which, counted from 1 on, once starve_begin was called. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

typedef int (*Create)(pthread_t *, const pthread_attr_t *, void *(*)(void *), void *);

static atomic_int asked;
static atomic_int first, last;

static int number(const char *name) {
    const char *text = getenv(name);
    return text != NULL ? atoi(text) : 0;
}

/* From here on threads are counted, and those that were named fail. */
void starve_begin(void) {
    atomic_store(&asked, 0);
    atomic_store(&first, number("STARVE_FIRST"));
    atomic_store(&last, number("STARVE_LAST"));
}

/* From here on no thread fails any more; gives how many were asked for. */
int starve_end(void) {
    atomic_store(&first, 0);
    atomic_store(&last, 0);
    return atomic_load(&asked);
}

int pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*work)(void *), void *argument) {
    static Create next;
    const int count = atomic_fetch_add(&asked, 1) + 1;
    if (count >= atomic_load(&first) && count <= atomic_load(&last)) {
        return EAGAIN;
    }
    if (next == NULL) {
        void *found = dlsym(RTLD_NEXT, "pthread_create");
        memcpy(&next, &found, sizeof next);
    }
    return next(thread, attributes, work, argument);
}
