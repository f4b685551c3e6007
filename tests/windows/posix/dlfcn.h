/* What tests/dist/tube.c takes of dlfcn.h, on Windows. */
#ifndef BESPOKE_TESTS_WINDOWS_DLFCN_H
#define BESPOKE_TESTS_WINDOWS_DLFCN_H

#include <string.h>
#include <windows.h>

static inline void *dlopen(const char *path, int flags) {
    wchar_t wide[1024];
    (void)flags;
    if (MultiByteToWideChar(CP_UTF8, 0, path, -1, wide, 1024) == 0) {
        return NULL;
    }
    return (void *)LoadLibraryW(wide);
}

static inline void *dlsym(void *library, const char *name) {
    FARPROC function = GetProcAddress((HMODULE)library, name);
    void *address;
    memcpy(&address, &function, sizeof address);
    return address;
}

static inline const char *dlerror(void) {
    return GetLastError() == ERROR_PROC_NOT_FOUND ? "the library has no such function" : "the library cannot be loaded";
}

#endif
