/* What a C library of 2.28 has no name for, and libraries that are linked in ask for: hidden in what is built. */

#define _GNU_SOURCE
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

/* Older C libraries have these, with the layout of the struct as their first argument. */
extern int __xstat(int version, const char *path, struct stat *status);
extern int __fxstat(int version, int file, struct stat *status);
extern int __xstat64(int version, const char *path, struct stat64 *status);
extern int __lxstat64(int version, const char *path, struct stat64 *status);
extern int __fxstat64(int version, int file, struct stat64 *status);

int stat(const char *path, struct stat *status)
{
    return __xstat(1, path, status);
}

int fstat(int file, struct stat *status)
{
    return __fxstat(1, file, status);
}

int stat64(const char *path, struct stat64 *status)
{
    return __xstat64(1, path, status);
}

int lstat64(const char *path, struct stat64 *status)
{
    return __lxstat64(1, path, status);
}

int fstat64(int file, struct stat64 *status)
{
    return __fxstat64(1, file, status);
}

pid_t gettid(void)
{
    return (pid_t)syscall(SYS_gettid);
}

/* Whether counts of references may do without atomic operations. Never. */
char __libc_single_threaded = 0;
