#ifdef _WIN32
#define WIN32_LEAN_AND_MEAN
#define _WIN32_WINNT 0x0601

#include "output.h"

#include "system.h"
#include "system_windows.h"

#include <errno.h>
#include <fcntl.h>
#include <io.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <windows.h>

/* Where a link leads; the path itself where it is none. Takes `path`. */
static wchar_t *followed(wchar_t *path) {
    const HANDLE file = CreateFileW(path, 0, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, NULL, OPEN_EXISTING,
                                    FILE_FLAG_BACKUP_SEMANTICS, NULL);
    if (file == INVALID_HANDLE_VALUE) {
        return path;
    }
    const DWORD size = GetFinalPathNameByHandleW(file, NULL, 0, 0);
    wchar_t *place = size > 0 ? malloc((size + 1) * sizeof *place) : NULL;
    const bool good = place != NULL && GetFinalPathNameByHandleW(file, place, size + 1, 0) != 0;
    CloseHandle(file);
    free(good ? path : place);
    return good ? place : path;
}

/* Makes a file beside `place` under a name that nobody has; its end replaces the seven characters at the end of `name`. */
static FILE *open_beside(wchar_t *name, size_t length) {
    static const wchar_t letters[] = L"abcdefghijklmnopqrstuvwxyz012345";
    unsigned long long number = (unsigned long long)GetCurrentProcessId() << 20 ^ GetTickCount64();
    for (int tries = 0; tries < 100; tries++, number = number * 6364136223846793005u + 1442695040888963407u) {
        for (size_t k = 0; k < 6; k++) {
            name[length + 1 + k] = letters[number >> (5 * k + 20) & 31];
        }
        const int descriptor =
            _wopen(name, _O_CREAT | _O_EXCL | _O_WRONLY | _O_BINARY | _O_NOINHERIT, _S_IREAD | _S_IWRITE);
        if (descriptor >= 0) {
            FILE *file = _wfdopen(descriptor, L"wb");
            if (file == NULL) {
                _close(descriptor);
                _wunlink(name);
            }
            return file;
        }
        if (errno != EEXIST) {
            return NULL;
        }
    }
    return NULL;
}

bool output_open(Output *output, const char *path, Message *message) {
    memset(output, 0, sizeof *output);
    wchar_t *place = system_wide_path(path);
    if (place == NULL) {
        return fail(message, "%s: cannot be written: %s", path, strerror(errno));
    }
    if (system_is_device(place)) {
        output->file = _wfopen(place, L"wb");
    } else {
        DWORD attributes = GetFileAttributesW(place);
        if (attributes != INVALID_FILE_ATTRIBUTES && (attributes & FILE_ATTRIBUTE_REPARSE_POINT) != 0) {
            /* The file behind the link is replaced, not the link. */
            place = followed(place);
            attributes = GetFileAttributesW(place);
        }
        if (attributes != INVALID_FILE_ATTRIBUTES && (attributes & FILE_ATTRIBUTE_DIRECTORY) != 0) {
            free(place);
            return fail(message, "%s: is a directory, a file is written here", path);
        }
        /* Who locked a file wants it to stay. */
        if (attributes != INVALID_FILE_ATTRIBUTES && (attributes & FILE_ATTRIBUTE_READONLY) != 0) {
            free(place);
            return fail(message, "%s: cannot be written: %s", path, strerror(EACCES));
        }
        const size_t length = wcslen(place);
        wchar_t *name = malloc((length + 8) * sizeof *name);
        if (name != NULL) {
            memcpy(name, place, length * sizeof *name);
            memcpy(name + length, L".XXXXXX", 8 * sizeof *name);
            output->file = open_beside(name, length);
            output->temporary = output->file != NULL ? system_narrow(name) : NULL;
            free(name);
        }
    }
    const int reason = errno;
    output->path = system_narrow(place);
    const bool is_whole = output->path != NULL && (output->temporary != NULL || system_is_device(place));
    free(place);
    if (output->file == NULL || !is_whole) {
        output_discard(output);
        return fail(message, "%s: cannot be written: %s", path, strerror(reason));
    }
    return true;
}

bool output_check(const char *path, Message *message) {
    wchar_t *place = system_wide_path(path);
    const bool is_device = place != NULL && system_is_device(place);
    free(place);
    if (is_device) {
        return true; /* opening a pipe now would end its reader */
    }
    Output output;
    const bool writable = output_open(&output, path, message);
    if (writable) {
        output_discard(&output);
    }
    return writable;
}

bool output_finish(Output *output, Message *message) {
    bool whole = fflush(output->file) == 0 && ferror(output->file) == 0;
    if (whole && output->temporary != NULL) {
        whole = _commit(_fileno(output->file)) == 0;
    }
    const int reason = errno;
    whole = fclose(output->file) == 0 && whole;
    output->file = NULL;
    return whole || fail(message, "%s: cannot be written: %s", output->path, strerror(reason));
}

bool output_commit(Output *output, Message *message) {
    if (output->temporary == NULL) {
        return true;
    }
    wchar_t *from = system_wide_path(output->temporary);
    wchar_t *to = system_wide_path(output->path);
    DWORD reason = from != NULL && to != NULL ? ERROR_SHARING_VIOLATION : ERROR_NOT_ENOUGH_MEMORY;
    /* Virus scanners and indexers open what is new for a moment. */
    for (int tries = 0; tries < 20 && (reason == ERROR_SHARING_VIOLATION || reason == ERROR_ACCESS_DENIED); tries++) {
        if (tries > 0) {
            Sleep(50);
        }
        reason = MoveFileExW(from, to, MOVEFILE_REPLACE_EXISTING | MOVEFILE_WRITE_THROUGH) ? 0 : GetLastError();
    }
    free(from);
    free(to);
    if (reason != 0) {
        char text[256];
        system_error_text(reason, text, sizeof text);
        return fail(message, "%s: cannot be put in place: %s", output->path, text);
    }
    free(output->temporary);
    output->temporary = NULL;
    return true;
}

void output_discard(Output *output) {
    if (output->file != NULL) {
        fclose(output->file);
    }
    if (output->temporary != NULL) {
        wchar_t *name = system_wide_path(output->temporary);
        if (name != NULL) {
            _wunlink(name);
        }
        free(name);
    }
    free(output->temporary);
    free(output->path);
    memset(output, 0, sizeof *output);
}
#else
typedef int not_for_this_system;
#endif
