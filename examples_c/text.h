/* Text files in memory, read word by word, and messages that say what is wrong with them. */
#ifndef TEXT_H
#define TEXT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* One message for a person. */
typedef struct Message {
    char text[1024];
} Message;

/* MinGW's printf is not that of Windows' C library, whose words a compiler would check. */
#ifdef __MINGW32__
#define PRINTF_FORMAT gnu_printf
#else
#define PRINTF_FORMAT printf
#endif

/* Writes the message; always false, so that `return fail(...)` reads well. */
bool fail(Message *message, const char *format, ...)
#if defined(__GNUC__)
    __attribute__((format(PRINTF_FORMAT, 2, 3)))
#endif
    ;

/* A whole file; a zero byte follows the last character. */
typedef struct Text {
    char *data;
    size_t size;
} Text;

bool text_read(Text *text, const char *path, Message *message);
void text_free(Text *text);

/* One line: from `begin` up to `end`, where its line break starts; `next` is the line after it. A backslash at the
   end of a line joins the next one to it, but not at the end of a comment. */
typedef struct Line {
    const char *begin;
    const char *end;
    const char *next;
    size_t number; /* of its first line, from 1 */
} Line;

/* The cursor before the first line, behind a byte order mark; line_next moves it on and is false after the last one. */
Line line_start(const Text *text);
bool line_next(Line *line, const Text *text);

/* The next word of the line from *at on: false at the end of the line or at a comment. Moves *at behind it. */
typedef struct Word {
    const char *begin;
    const char *end;
} Word;

bool word_next(Word *word, const char **at, const Line *line);
bool word_is(Word word, const char *text);

/* The word as a finite number or a whole number. False where it is not one, or is out of range. */
bool word_number(Word word, double *value);
bool word_integer(Word word, int64_t *value);

/* malloc(count * size) that cannot overflow and is never a null pointer for count 0. */
void *array_new(size_t count, size_t size);

#endif
