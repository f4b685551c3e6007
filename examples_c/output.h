/* Files that appear whole or not at all: written beside their place under another name, then renamed. */
#ifndef OUTPUT_H
#define OUTPUT_H

#include <stdio.h>

#include "text.h"

typedef struct Output {
    FILE *file;      /* where to write */
    char *path;      /* the place it will have */
    char *temporary; /* its name until then; null for a pipe or a device, which is written in place */
} Output;

/* False, with a message, where nothing could be written at `path` later: a directory, no such folder, no right. */
bool output_check(const char *path, Message *message);

bool output_open(Output *output, const char *path, Message *message);

/* Everything is on the disk; only the rename is left. */
bool output_finish(Output *output, Message *message);

/* Puts a finished file in its place. */
bool output_commit(Output *output, Message *message);

/* Removes whatever was not committed. Safe on a zeroed, a committed and a discarded output. */
void output_discard(Output *output);

#endif
