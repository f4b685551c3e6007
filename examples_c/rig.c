#include "rig.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Behind the name: the parent and the bind transform. */
enum { TAIL = 17 };

static size_t count_lines(const Text *text) {
    size_t count = 0;
    for (Line line = line_start(text); line_next(&line, text);) {
        count++;
    }
    return count;
}

static size_t count_in_line(const Line *line) {
    const char *at = line->begin;
    size_t count = 0;
    for (Word word; word_next(&word, &at, line);) {
        count++;
    }
    return count;
}

/* Copies the words of a name to `to`, with one blank between them and a zero byte behind them; returns what follows that. */
static char *copy_name(char *to, const char **at, const Line *line, size_t words) {
    for (size_t k = 0; k < words; k++) {
        Word word;
        if (!word_next(&word, at, line)) {
            break;
        }
        if (k > 0) {
            *to++ = ' ';
        }
        const size_t length = (size_t)(word.end - word.begin);
        memcpy(to, word.begin, length);
        to += length;
    }
    *to++ = '\0';
    return to;
}

static bool rig_parse(Rig *rig, const Text *text, const char *path, Message *message) {
    char *free_name = rig->names;
    for (Line line = line_start(text); line_next(&line, text);) {
        const size_t words = count_in_line(&line);
        const char *at = line.begin;
        Word word;
        if (!word_next(&word, &at, &line)) {
            continue;
        }
        if (!word_is(word, "joint") || words < 1 + TAIL) {
            return fail(message, "%s: line %zu: is not: joint NAME PARENT and 16 numbers", path, line.number);
        }
        BespokeJoint *joint = &rig->joints[rig->count++];
        joint->name = free_name;
        free_name = copy_name(free_name, &at, &line, words - 1 - TAIL);
        int64_t parent;
        if (!word_next(&word, &at, &line) || !word_integer(word, &parent) || parent < -1 || parent >= UINT32_MAX) {
            return fail(message, "%s: line %zu: the parent is no joint counted from 0, and not -1", path, line.number);
        }
        joint->parent = parent < 0 ? BESPOKE_NO_JOINT : (uint32_t)parent;
        for (size_t k = 0; k < 16; k++) {
            if (!word_next(&word, &at, &line) || !word_number(word, &joint->bind[k])) {
                return fail(message, "%s: line %zu: number %zu of the bind transform is not a finite number", path,
                            line.number, k + 1);
            }
        }
    }
    return rig->count > 0 || fail(message, "%s: holds no joints", path);
}

bool rig_read(Rig *rig, const char *path, Message *message) {
    memset(rig, 0, sizeof *rig);
    Text text;
    if (!text_read(&text, path, message)) {
        return false;
    }
    const size_t lines = count_lines(&text);
    rig->joints = calloc(lines + 1, sizeof *rig->joints);
    /* A name takes no more than its line, with the zero byte in place of a blank; an empty one its zero byte. */
    rig->names = array_new(text.size + lines + 1, 1);
    const bool fits = rig->joints != NULL && rig->names != NULL;
    const bool good =
        fits ? rig_parse(rig, &text, path, message) : fail(message, "%s: does not fit into memory", path);
    text_free(&text);
    if (!good) {
        rig_free(rig);
    }
    return good;
}

void rig_free(Rig *rig) {
    free(rig->joints);
    free(rig->names);
    memset(rig, 0, sizeof *rig);
}

void rig_write_joint(FILE *file, const char *name, uint32_t parent, const double bind[BESPOKE_TRANSFORM_SIZE]) {
    fprintf(file, "joint %s %ld", name, parent == BESPOKE_NO_JOINT ? -1L : (long)parent);
    for (size_t k = 0; k < BESPOKE_TRANSFORM_SIZE; k++) {
        fprintf(file, " %.17g", bind[k]);
    }
    fprintf(file, "\n");
}

static bool influences_parse(Influences *influences, const Text *text, const char *path, Message *message) {
    for (Line line = line_start(text); line_next(&line, text);) {
        const size_t words = count_in_line(&line);
        if (words == 0) {
            continue;
        }
        if (words % 2 != 0) {
            return fail(message, "%s: line %zu: has %zu words; a joint and its weight are two", path, line.number, words);
        }
        const char *at = line.begin;
        for (size_t k = 0; k < words / 2; k++) {
            const size_t place = influences->count * influences->width + k;
            Word word;
            int64_t joint;
            double weight;
            if (!word_next(&word, &at, &line) || !word_integer(word, &joint) || joint < 0 || joint >= UINT32_MAX) {
                return fail(message, "%s: line %zu: joint %zu is not a whole number from 0", path, line.number, k + 1);
            }
            if (!word_next(&word, &at, &line) || !word_number(word, &weight) || fabs(weight) > (double)FLT_MAX) {
                return fail(message, "%s: line %zu: weight %zu is not a finite number", path, line.number, k + 1);
            }
            influences->joints[place] = (uint32_t)joint;
            influences->weights[place] = (float)weight;
        }
        influences->count++;
    }
    return influences->count > 0 || fail(message, "%s: holds no weights", path);
}

bool influences_read(Influences *influences, const char *path, Message *message) {
    memset(influences, 0, sizeof *influences);
    Text text;
    if (!text_read(&text, path, message)) {
        return false;
    }
    size_t lines = 0;
    for (Line line = line_start(&text); line_next(&line, &text); lines++) {
        const size_t pairs = count_in_line(&line) / 2;
        influences->width = pairs > influences->width ? pairs : influences->width;
    }
    const size_t room = influences->width == 0 || lines < SIZE_MAX / influences->width ? lines * influences->width : SIZE_MAX;
    influences->joints = calloc(room > 0 ? room : 1, sizeof *influences->joints);
    influences->weights = calloc(room > 0 ? room : 1, sizeof *influences->weights);
    const bool fits = influences->joints != NULL && influences->weights != NULL;
    const bool good = fits ? influences_parse(influences, &text, path, message)
                           : fail(message, "%s: does not fit into memory", path);
    text_free(&text);
    if (!good) {
        influences_free(influences);
    }
    return good;
}

void influences_free(Influences *influences) {
    free(influences->joints);
    free(influences->weights);
    memset(influences, 0, sizeof *influences);
}
