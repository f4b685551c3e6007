/* A process into which the library is loaded as a plugin:

     host plain LIBRARY                        dresses
     host tbb LIBRARY TBB WORK local|global    the same beside another TBB with global symbols, which WORK uses
     host reopen LIBRARY                       opens, dresses and closes, several times
     host copies LIBRARY COPY                  two copies with global symbols, in use at once
     host apart LIBRARY COPY                   the same, but nothing of the first may be called while the second works
     host starve LIBRARY THREADS load|work     lets threads fail (starve.c, preloaded): from before the library is loaded
                                               on, or from after that; then dresses again with all that it asks for

   Prints the hash of the result (tube.h), and ends with 1 and a sentence where something is not as it should be. */
#include <dirent.h>
#include <dlfcn.h>
#include <inttypes.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <time.h>

#include "tube.h"

#define ROUNDS 3

typedef int (*Work)(void);

static atomic_bool working;
static atomic_int rounds_of_work;

static void *work_all_the_time(void *work) {
    Work function;
    memcpy(&function, &work, sizeof function);
    while (atomic_load(&working)) {
        if (!function()) {
            tube_fail("the work of the host came out wrong");
        }
        atomic_fetch_add(&rounds_of_work, 1);
    }
    return NULL;
}

static void work_once(Work work, const char *when) {
    if (!work()) {
        tube_fail("the work of the host came out wrong %s", when);
    }
}

static uint64_t beside_tbb(const char *path, const char *tbb, const char *worker, int flags) {
    tube_open(tbb, RTLD_NOW | RTLD_GLOBAL);
    void *symbol = dlsym(tube_open(worker, RTLD_NOW | RTLD_LOCAL), "host_work");
    if (symbol == NULL) {
        tube_fail("%s", dlerror());
    }
    Work work;
    memcpy(&work, &symbol, sizeof work);
    work_once(work, "before the library was there");
    void *library = tube_open(path, RTLD_NOW | flags);
    work_once(work, "once the library was there");
    atomic_store(&working, true);
    pthread_t thread;
    pthread_create(&thread, NULL, work_all_the_time, symbol);
    uint64_t hash = 0;
    for (int k = 0; k < ROUNDS; k++) {
        hash = tube_dress(library);
        printf("%016" PRIx64 "\n", hash);
    }
    atomic_store(&working, false);
    pthread_join(thread, NULL);
    if (atomic_load(&rounds_of_work) == 0) {
        tube_fail("the host did no work beside the library");
    }
    work_once(work, "after the library had worked");
    dlclose(library);
    work_once(work, "after the library was closed");
    return hash;
}

/* Files in memory whose name holds "tbb", one line each. */
static void print_tbb(void) {
    char line[4096], last[4096] = "";
    FILE *maps = fopen("/proc/self/maps", "r");
    while (maps != NULL && fgets(line, sizeof line, maps) != NULL) {
        const char *path = strchr(line, '/');
        if (path != NULL && strstr(path, "libtbb") != NULL && strcmp(path, last) != 0) {
            strcpy(last, path);
            printf("loaded %s", path);
        }
    }
    if (maps != NULL) {
        fclose(maps);
    }
}

static int threads(void) {
    int count = 0;
    DIR *tasks = opendir("/proc/self/task");
    for (struct dirent *entry; tasks != NULL && (entry = readdir(tasks)) != NULL;) {
        count += entry->d_name[0] != '.';
    }
    closedir(tasks);
    return count;
}

/* A thread that ends is counted for a moment longer. */
static void expect_threads(int most) {
    const struct timespec moment = {0, 20000000};
    for (int k = 0; k < 250 && threads() > most; k++) {
        nanosleep(&moment, NULL);
    }
    if (threads() > most) {
        tube_fail("there are %d threads after the last session, and %d at most were expected", threads(), most);
    }
}

/* What is there after the first round is all there will ever be. */
static uint64_t reopened(const char *path) {
    uint64_t first = 0;
    int most = 0;
    for (int round = 0; round < ROUNDS; round++) {
        void *library = tube_open(path, RTLD_NOW | RTLD_LOCAL);
        const uint64_t hash = tube_dress(library);
        if (dlclose(library) != 0) {
            tube_fail("%s", dlerror());
        }
        if (round == 0) {
            first = hash;
            const struct timespec moment = {0, 500000000};
            nanosleep(&moment, NULL);
            most = threads();
        }
        if (hash != first) {
            tube_fail("round %d gives other bits", round);
        }
        expect_threads(most);
    }
    printf("threads %d\n", most);
    return first;
}

static void *dress(void *library) {
    uint64_t hash = 0;
    for (int k = 0; k < ROUNDS; k++) {
        hash = tube_dress(library);
    }
    return (void *)(uintptr_t)hash;
}

static uint64_t two_copies(const char *path, const char *copy) {
    void *libraries[2] = {tube_open(path, RTLD_NOW | RTLD_GLOBAL), tube_open(copy, RTLD_NOW | RTLD_GLOBAL)};
    if (libraries[0] == libraries[1]) {
        tube_fail("the loader takes the two copies for one");
    }
    pthread_t threads[2];
    void *hashes[2];
    for (int k = 0; k < 2; k++) {
        pthread_create(&threads[k], NULL, dress, libraries[k]);
    }
    for (int k = 0; k < 2; k++) {
        pthread_join(threads[k], &hashes[k]);
    }
    if (hashes[0] != hashes[1]) {
        tube_fail("the two copies give different bits");
    }
    return (uint64_t)(uintptr_t)hashes[0];
}

/* Makes the code of a loaded file runnable or not. */
static void let_run(const char *path, int allowed) {
    char line[4096];
    int count = 0;
    FILE *maps = fopen("/proc/self/maps", "r");
    while (maps != NULL && fgets(line, sizeof line, maps) != NULL) {
        uintptr_t begin, end;
        char rights[8] = "";
        const char *file = strchr(line, '/');
        if (file == NULL || strncmp(file, path, strlen(path)) != 0 ||
            sscanf(line, "%" SCNxPTR "-%" SCNxPTR " %7s", &begin, &end, rights) != 3) {
            continue;
        }
        const int is_code = allowed ? strcmp(rights, "---p") == 0 : rights[2] == 'x';
        if (is_code) {
            count += mprotect((void *)begin, end - begin, allowed ? PROT_READ | PROT_EXEC : PROT_NONE) == 0;
        }
    }
    if (maps != NULL) {
        fclose(maps);
    }
    if (count == 0) {
        tube_fail("no code of %s was found", path);
    }
}

/* The first copy comes first for every symbol that is looked up, and its code cannot run: a call into it is a crash. */
static uint64_t kept_apart(const char *path, const char *copy) {
    tube_open(path, RTLD_NOW | RTLD_GLOBAL);
    let_run(path, 0);
    void *second = tube_open(copy, RTLD_NOW | RTLD_GLOBAL);
    const uint64_t hash = tube_dress(second);
    /* Its destructors have to run at the end of the process. */
    let_run(path, 1);
    return hash;
}

/* What starve.c defines, where it is loaded. */
extern void starve_begin(void) __attribute__((weak));
extern int starve_end(void) __attribute__((weak));

static uint64_t starved(const char *path, unsigned thread_count, int from_load) {
    if (starve_begin == NULL || starve_end == NULL) {
        tube_fail("starve.c is not loaded");
    }
    if (from_load) {
        starve_begin();
    }
    void *library = tube_open(path, RTLD_NOW | RTLD_LOCAL);
    if (!from_load) {
        starve_begin();
    }
    char message[TUBE_MESSAGE];
    uint64_t hash = 0, again = 0;
    const unsigned status = tube_try(library, thread_count, &hash, message);
    printf("asked %d\nstatus %u %s\n", starve_end(), status, message);
    if (tube_try(library, thread_count, &again, message) != 0) {
        tube_fail("with all the threads it asks for it fails: %s", message);
    }
    if (status == 0 && hash != again) {
        tube_fail("fewer threads give other bits");
    }
    printf("left %d\n", threads());
    return again;
}

int main(int count, char **words) {
    const char *what = count > 2 ? words[1] : "";
    uint64_t hash = 0;
    if (strcmp(what, "plain") == 0 && count == 3) {
        hash = tube_dress(tube_open(words[2], RTLD_NOW | RTLD_LOCAL));
    } else if (strcmp(what, "tbb") == 0 && count == 6) {
        const int flags = strcmp(words[5], "global") == 0 ? RTLD_GLOBAL : RTLD_LOCAL;
        hash = beside_tbb(words[2], words[3], words[4], flags);
    } else if (strcmp(what, "reopen") == 0 && count == 3) {
        hash = reopened(words[2]);
    } else if (strcmp(what, "copies") == 0 && count == 4) {
        hash = two_copies(words[2], words[3]);
    } else if (strcmp(what, "apart") == 0 && count == 4) {
        hash = kept_apart(words[2], words[3]);
    } else if (strcmp(what, "starve") == 0 && count == 5) {
        hash = starved(words[2], (unsigned)atoi(words[3]), strcmp(words[4], "load") == 0);
    } else {
        tube_fail("the head of host.c says what can be asked");
    }
    print_tbb();
    printf("%016" PRIx64 "\n", hash);
    return 0;
}
