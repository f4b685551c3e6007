#ifndef _WIN32
#define _XOPEN_SOURCE 700

#include "system.h"

#include <signal.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

char **system_words(int *count, char **words) {
    (void)count;
    return words;
}

void system_words_free(char **words, char **given) {
    (void)words;
    (void)given;
}

FILE *system_open(const char *path, const char *mode) {
    return fopen(path, mode);
}

bool system_is_folder(const char *path) {
    struct stat status;
    return stat(path, &status) == 0 && S_ISDIR(status.st_mode);
}

void system_on_stop(void (*stop)(int number)) {
    const int numbers[] = {SIGINT, SIGTERM, SIGHUP};
    for (int k = 0; k < 3; k++) {
        struct sigaction action;
        /* Somebody who started us with the signal ignored (nohup) wants it ignored. */
        if (sigaction(numbers[k], NULL, &action) == 0 && action.sa_handler != SIG_IGN) {
            memset(&action, 0, sizeof action);
            action.sa_handler = stop;
            action.sa_flags = SA_RESTART;
            sigemptyset(&action.sa_mask);
            sigaction(numbers[k], &action, NULL);
        }
    }
    /* A reader that went away and a limit on file sizes are errors of writing, with a sentence. */
    signal(SIGPIPE, SIG_IGN);
    signal(SIGXFSZ, SIG_IGN);
}

bool system_is_terminal(void) {
    return isatty(STDOUT_FILENO) != 0;
}

double system_seconds(void) {
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

uint64_t system_peak_memory(void) {
    struct rusage usage;
    if (getrusage(RUSAGE_SELF, &usage) != 0) {
        return 0;
    }
#ifdef __APPLE__
    return (uint64_t)usage.ru_maxrss;
#else
    return (uint64_t)usage.ru_maxrss * 1024;
#endif
}
#else
typedef int not_for_this_system;
#endif
