/* A process of Windows into which the library is loaded as a plugin:

     host plain LIBRARY          dresses
     host reopen LIBRARY         opens, dresses and closes, several times; then a thread that was there all the time ends
     host copies LIBRARY COPY    two copies, in use at once
     host foreign LIBRARY        from a thread of the host that has a small stack, and flushes subnormal numbers to zero

   Prints the hash of the result (tests/dist/tube.h), and ends with 1 and a sentence where something is not as it should be. */
#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <xmmintrin.h>
#include <windows.h>

#include "../dist/tube.h"

#define ROUNDS 3
#define FLUSHING 0x8040u

static DWORD WINAPI dress(void *library) {
    uint64_t hash = 0;
    for (int k = 0; k < ROUNDS; k++) {
        hash = tube_dress(library);
    }
    return (DWORD)(hash ^ hash >> 32);
}

static uint64_t two_copies(const char *path, const char *copy) {
    void *libraries[2] = {tube_open(path, 0), tube_open(copy, 0)};
    if (libraries[0] == libraries[1]) {
        tube_fail("the loader takes the two copies for one");
    }
    HANDLE threads[2];
    DWORD hashes[2];
    for (int k = 0; k < 2; k++) {
        threads[k] = CreateThread(NULL, 0, dress, libraries[k], 0, NULL);
    }
    WaitForMultipleObjects(2, threads, TRUE, INFINITE);
    for (int k = 0; k < 2; k++) {
        GetExitCodeThread(threads[k], &hashes[k]);
    }
    if (hashes[0] != hashes[1]) {
        tube_fail("the two copies give different bits");
    }
    return tube_dress(libraries[0]);
}

/* Dresses, waits until the library was closed, and ends: with whatever the library has left in it. */
typedef struct Long {
    const char *path;
    HANDLE dressed, closed;
} Long;

static DWORD WINAPI outlive(void *argument) {
    const Long *life = argument;
    void *library = tube_open(life->path, 0);
    tube_dress(library);
    FreeLibrary(library);
    SetEvent(life->dressed);
    WaitForSingleObject(life->closed, INFINITE);
    return 0;
}

static uint64_t reopened(const char *path) {
    const Long life = {path, CreateEventW(NULL, TRUE, FALSE, NULL), CreateEventW(NULL, TRUE, FALSE, NULL)};
    HANDLE thread = CreateThread(NULL, 0, outlive, (void *)&life, 0, NULL);
    WaitForSingleObject(life.dressed, INFINITE);
    uint64_t first = 0;
    for (int round = 0; round < ROUNDS; round++) {
        void *library = tube_open(path, 0);
        const uint64_t hash = tube_dress(library);
        if (!FreeLibrary(library)) {
            tube_fail("the library cannot be closed");
        }
        first = round == 0 ? hash : first;
        if (hash != first) {
            tube_fail("round %d gives other bits", round);
        }
    }
    SetEvent(life.closed);
    DWORD code = 1;
    if (WaitForSingleObject(thread, 60000) != WAIT_OBJECT_0 || !GetExitCodeThread(thread, &code) || code != 0) {
        tube_fail("the thread that outlived the library did not end well");
    }
    return first;
}

static uint64_t foreign_hash;

static DWORD WINAPI dress_flushing(void *library) {
    const unsigned before = _mm_getcsr() | FLUSHING;
    _mm_setcsr(before);
    foreign_hash = tube_dress(library);
    const unsigned after = _mm_getcsr();
    if ((after & ~0x3fu) != (before & ~0x3fu)) {
        tube_fail("the mode of the thread was %x and is %x", before, after);
    }
    return 0;
}

static uint64_t foreign(const char *path) {
    HANDLE thread =
        CreateThread(NULL, 128 * 1024, dress_flushing, tube_open(path, 0), STACK_SIZE_PARAM_IS_A_RESERVATION, NULL);
    if (thread == NULL || WaitForSingleObject(thread, INFINITE) != WAIT_OBJECT_0) {
        tube_fail("the host has no threads");
    }
    return foreign_hash;
}

int main(int count, char **words) {
    const char *what = count > 2 ? words[1] : "";
    uint64_t hash = 0;
    if (strcmp(what, "plain") == 0 && count == 3) {
        hash = tube_dress(tube_open(words[2], 0));
    } else if (strcmp(what, "reopen") == 0 && count == 3) {
        hash = reopened(words[2]);
    } else if (strcmp(what, "copies") == 0 && count == 4) {
        hash = two_copies(words[2], words[3]);
    } else if (strcmp(what, "foreign") == 0 && count == 3) {
        hash = foreign(words[2]);
    } else {
        tube_fail("the head of host.c says what can be asked");
    }
    printf("%016" PRIx64 "\n", hash);
    return 0;
}
