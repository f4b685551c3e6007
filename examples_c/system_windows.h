/* Names of files as Windows takes them. */
#ifndef SYSTEM_WINDOWS_H
#define SYSTEM_WINDOWS_H

#include <stdbool.h>
#include <stddef.h>
#include <wchar.h>

/* The whole path in UTF-16, in the form that may be longer than 260 characters; null, with errno, where it cannot be had.
   To be freed. */
wchar_t *system_wide_path(const char *path);

/* UTF-8 from UTF-16; null without memory. To be freed. */
char *system_narrow(const wchar_t *text);

/* Whether a path that system_wide_path made names a device or a pipe, such as NUL. */
bool system_is_device(const wchar_t *path);

/* What Windows calls an error, without a full stop, in UTF-8. */
void system_error_text(unsigned long number, char *text, size_t size);

#endif
