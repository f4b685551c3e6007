#include "text.h"

#include "system.h"

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool fail(Message *message, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message->text, sizeof message->text, format, arguments);
    va_end(arguments);
    return false;
}

void *array_new(size_t count, size_t size) {
    if (count > SIZE_MAX / size) {
        return NULL;
    }
    return malloc(count > 0 ? count * size : 1);
}

bool text_read(Text *text, const char *path, Message *message) {
    text->data = NULL;
    text->size = 0;
    FILE *file = system_open(path, "rb");
    const int reason = errno;
    if (system_is_folder(path)) {
        if (file != NULL) {
            fclose(file);
        }
        return fail(message, "%s: is a directory, not a file", path);
    }
    if (file == NULL) {
        return fail(message, "%s: cannot be opened: %s", path, strerror(reason));
    }
    /* Grown while reading: a pipe does not know its size. */
    size_t capacity = 1 << 16;
    char *data = malloc(capacity);
    size_t size = 0;
    while (data != NULL) {
        size += fread(data + size, 1, capacity - 1 - size, file);
        if (size < capacity - 1) {
            break;
        }
        char *larger = capacity < SIZE_MAX / 2 ? realloc(data, capacity * 2) : NULL;
        if (larger == NULL) {
            free(data);
        }
        data = larger;
        capacity *= 2;
    }
    const bool broken = ferror(file) != 0;
    fclose(file);
    if (data == NULL) {
        return fail(message, "%s: does not fit into memory", path);
    }
    data[size] = '\0';
    if (broken || memchr(data, '\0', size) != NULL) {
        free(data);
        return fail(message, broken ? "%s: cannot be read to its end" : "%s: is not a text file", path);
    }
    text->data = data;
    text->size = size;
    return true;
}

void text_free(Text *text) {
    free(text->data);
    text->data = NULL;
    text->size = 0;
}

Line line_start(const Text *text) {
    /* Some editors put a byte order mark in front, which would spoil the first word. */
    static const char mark[] = "\xEF\xBB\xBF";
    const size_t skipped = text->size >= 3 && memcmp(text->data, mark, 3) == 0 ? 3 : 0;
    const char *begin = text->data + skipped;
    const Line line = {begin, begin, begin, 0};
    return line;
}

/* The character before a line break, where a carriage return belongs to the break. */
static const char *break_begin(const char *begin, const char *feed) {
    return feed > begin && feed[-1] == '\r' ? feed - 1 : feed;
}

bool line_next(Line *line, const Text *text) {
    const char *stop = text->data + text->size;
    /* How many line breaks the last line held: one, and one for each backslash that joined two. */
    size_t breaks = line->number == 0 ? 1 : 0;
    for (const char *c = line->begin; c < line->next; c++) {
        breaks += *c == '\n';
    }
    line->begin = line->next;
    if (line->begin >= stop) {
        return false;
    }
    line->number += breaks;
    const char *from = line->begin;
    const char *first = from;
    while (first < stop && (*first == ' ' || *first == '\t')) {
        first++;
    }
    /* A comment may end with the backslash of a path, and is over at the end of its line nevertheless. */
    const bool is_comment = first < stop && *first == '#';
    for (;;) {
        const char *feed = memchr(from, '\n', (size_t)(stop - from));
        line->end = break_begin(line->begin, feed != NULL ? feed : stop);
        line->next = feed != NULL ? feed + 1 : stop;
        if (feed == NULL || is_comment || line->end == line->begin || line->end[-1] != '\\' || line->next == stop) {
            return true;
        }
        from = line->next;
    }
}

static bool is_blank(const char *c, const Line *line) {
    if (*c == '\\') { /* only where it joins two lines */
        return c + 1 < line->end && (c[1] == '\n' || c[1] == '\r');
    }
    return *c == ' ' || *c == '\t' || *c == '\r' || *c == '\n' || *c == '\v' || *c == '\f';
}

bool word_next(Word *word, const char **at, const Line *line) {
    const char *c = *at;
    while (c < line->end && is_blank(c, line)) {
        c++;
    }
    word->begin = c;
    while (c < line->end && !is_blank(c, line)) {
        c++;
    }
    word->end = c;
    *at = c;
    return word->begin < word->end && *word->begin != '#';
}

bool word_is(Word word, const char *text) {
    const size_t length = (size_t)(word.end - word.begin);
    return strlen(text) == length && memcmp(word.begin, text, length) == 0;
}

bool word_number(Word word, double *value) {
    /* The text ends with a zero byte and the word with a blank, so strtod stays inside. */
    char *end = NULL;
    *value = strtod(word.begin, &end);
    return end == word.end && isfinite(*value);
}

bool word_integer(Word word, int64_t *value) {
    const char *c = word.begin;
    const bool negative = c < word.end && *c == '-';
    c += negative || (c < word.end && *c == '+');
    if (c == word.end) {
        return false;
    }
    int64_t sum = 0;
    for (; c < word.end; c++) {
        if (*c < '0' || *c > '9' || sum > INT64_MAX / 10 - 1) {
            return false;
        }
        sum = sum * 10 + (*c - '0');
    }
    *value = negative ? -sum : sum;
    return true;
}
