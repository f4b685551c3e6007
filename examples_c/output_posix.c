#ifndef _WIN32
#define _XOPEN_SOURCE 700

#include "output.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

bool output_open(Output *output, const char *path, Message *message) {
    memset(output, 0, sizeof *output);
    struct stat status;
    const bool exists = stat(path, &status) == 0;
    if (exists && S_ISDIR(status.st_mode)) {
        return fail(message, "%s: is a directory, a file is written here", path);
    }
    /* The rename would not care, but who locked a file wants it to stay. */
    if (exists && access(path, W_OK) != 0) {
        return fail(message, "%s: cannot be written: %s", path, strerror(errno));
    }
    /* Behind a symbolic link: the file is replaced, not the link. */
    char *place = exists ? realpath(path, NULL) : NULL;
    const char *chosen = place != NULL ? place : path;
    const size_t length = strlen(chosen);
    output->path = malloc(length + 1);
    output->temporary = exists && !S_ISREG(status.st_mode) ? NULL : malloc(length + sizeof ".XXXXXX");
    if (output->path != NULL) {
        memcpy(output->path, chosen, length + 1);
    }
    int descriptor = -1;
    if (output->temporary != NULL) {
        memcpy(output->temporary, chosen, length);
        memcpy(output->temporary + length, ".XXXXXX", sizeof ".XXXXXX");
        descriptor = mkstemp(output->temporary);
        if (descriptor < 0) {
            free(output->temporary);
            output->temporary = NULL;
        } else {
            /* mkstemp hides the file from others; the result has the rights of any new file, or of the old one. */
            const mode_t mask = umask(0);
            umask(mask);
            (void)fchmod(descriptor, exists ? status.st_mode & 0777 : 0666 & ~mask);
            output->file = fdopen(descriptor, "wb");
        }
    } else if (exists && !S_ISREG(status.st_mode)) {
        output->file = fopen(chosen, "wb");
    }
    const int reason = errno;
    free(place);
    if (output->file == NULL || output->path == NULL) {
        if (output->file == NULL && descriptor >= 0) {
            close(descriptor);
        }
        output_discard(output);
        return fail(message, "%s: cannot be written: %s", path, strerror(reason));
    }
    return true;
}

bool output_check(const char *path, Message *message) {
    struct stat status;
    if (stat(path, &status) == 0 && !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode)) {
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
        whole = fsync(fileno(output->file)) == 0;
    }
    const int reason = errno;
    whole = fclose(output->file) == 0 && whole;
    output->file = NULL;
    return whole || fail(message, "%s: cannot be written: %s", output->path, strerror(reason));
}

bool output_commit(Output *output, Message *message) {
    if (output->temporary != NULL) {
        if (rename(output->temporary, output->path) != 0) {
            return fail(message, "%s: cannot be put in place: %s", output->path, strerror(errno));
        }
        free(output->temporary);
        output->temporary = NULL;
    }
    return true;
}

void output_discard(Output *output) {
    if (output->file != NULL) {
        fclose(output->file);
    }
    if (output->temporary != NULL) {
        unlink(output->temporary);
    }
    free(output->temporary);
    free(output->path);
    memset(output, 0, sizeof *output);
}
#else
typedef int not_for_this_system;
#endif
