#include "numbers.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static int shown_length(Word word) {
    return (int)(word.end - word.begin > 40 ? 40 : word.end - word.begin);
}

static size_t count_words(const Text *text) {
    size_t count = 0;
    for (Line line = line_start(text); line_next(&line, text);) {
        const char *at = line.begin;
        for (Word word; word_next(&word, &at, &line);) {
            count++;
        }
    }
    return count;
}

static bool matrix_parse(Matrix *matrix, const Text *text, const char *path, Message *message) {
    size_t count = 0;
    for (Line line = line_start(text); line_next(&line, text);) {
        const char *at = line.begin;
        const size_t before = count;
        for (Word word; word_next(&word, &at, &line); count++) {
            double value;
            if (!word_number(word, &value) || fabs(value) > (double)FLT_MAX) {
                return fail(message, "%s: line %zu: '%.*s' is not a finite number", path, line.number,
                            shown_length(word), word.begin);
            }
            matrix->values[count] = (float)value;
        }
        const size_t columns = count - before;
        if (columns == 0) {
            continue;
        }
        if (matrix->rows > 0 && columns != matrix->columns) {
            return fail(message, "%s: line %zu: has %zu numbers where the rows before have %zu", path, line.number,
                        columns, matrix->columns);
        }
        matrix->columns = columns;
        matrix->rows++;
    }
    return matrix->rows > 0 || fail(message, "%s: holds no numbers", path);
}

bool matrix_read(Matrix *matrix, const char *path, Message *message) {
    memset(matrix, 0, sizeof *matrix);
    Text text;
    if (!text_read(&text, path, message)) {
        return false;
    }
    matrix->values = array_new(count_words(&text), sizeof(float));
    const bool good = matrix->values != NULL ? matrix_parse(matrix, &text, path, message)
                                             : fail(message, "%s: does not fit into memory", path);
    text_free(&text);
    if (!good) {
        matrix_free(matrix);
    }
    return good;
}

void matrix_free(Matrix *matrix) {
    free(matrix->values);
    memset(matrix, 0, sizeof *matrix);
}

static bool list_parse(List *list, const Text *text, const char *path, Message *message) {
    for (Line line = line_start(text); line_next(&line, text);) {
        const char *at = line.begin;
        for (Word word; word_next(&word, &at, &line); list->count++) {
            int64_t value;
            if (!word_integer(word, &value) || value < 0 || value >= (int64_t)UINT32_MAX) {
                return fail(message, "%s: line %zu: '%.*s' is not a vertex (a whole number from 0)", path, line.number,
                            shown_length(word), word.begin);
            }
            list->values[list->count] = (uint32_t)value;
        }
        if (list->count > (list->rows > 0 ? list->ends[list->rows - 1] : 0)) {
            list->ends[list->rows++] = list->count;
        }
    }
    return true;
}

bool list_read(List *list, const char *path, Message *message) {
    memset(list, 0, sizeof *list);
    Text text;
    if (!text_read(&text, path, message)) {
        return false;
    }
    const size_t words = count_words(&text);
    list->values = array_new(words, sizeof(uint32_t));
    list->ends = array_new(words, sizeof(size_t));
    const bool fits = list->values != NULL && list->ends != NULL;
    const bool good = fits ? list_parse(list, &text, path, message)
                           : fail(message, "%s: does not fit into memory", path);
    text_free(&text);
    if (!good) {
        list_free(list);
    }
    return good;
}

void list_free(List *list) {
    free(list->values);
    free(list->ends);
    memset(list, 0, sizeof *list);
}
