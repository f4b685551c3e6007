#include "curves.h"

#include <stdlib.h>

#include "text.h"

typedef struct Curve {
    uint32_t *vertices;
    size_t count;
    uint32_t closed;
    double weights[2];
} Curve;

static int shown_length(Word word) {
    return (int)(word.end - word.begin > 40 ? 40 : word.end - word.begin);
}

/* The k-th word of a line. */
static bool word_parse(Curve *curve, size_t k, Word word, const char *path, size_t line, Message *message) {
    int64_t vertex;
    if (k == 0) {
        curve->closed = word_is(word, "closed") ? 1 : 0;
        return curve->closed == 1 || word_is(word, "open") ||
               fail(message, "%s: line %zu: '%.*s' is neither open nor closed", path, line, shown_length(word),
                    word.begin);
    }
    if (k <= 2) {
        return word_number(word, &curve->weights[k - 1]) ||
               fail(message, "%s: line %zu: '%.*s' is not a weight", path, line, shown_length(word), word.begin);
    }
    if (!word_integer(word, &vertex) || vertex < 0 || vertex >= (int64_t)UINT32_MAX) {
        return fail(message, "%s: line %zu: '%.*s' is not a vertex (a whole number from 0)", path, line,
                    shown_length(word), word.begin);
    }
    curve->vertices[curve->count++] = (uint32_t)vertex;
    return true;
}

static bool line_add(Session *session, Curve *curve, const Line *line, const char *path) {
    const char *at = line->begin;
    size_t words = 0;
    curve->count = 0;
    for (Word word; word_next(&word, &at, line); words++) {
        if (!word_parse(curve, words, word, path, line->number, &session->message)) {
            return false;
        }
    }
    if (words == 0) {
        return true;
    }
    if (words < 3) {
        return fail(&session->message,
                    "%s: line %zu: has %zu words; a curve is open or closed, its curve weight, its position weight, "
                    "and its vertices",
                    path, line->number, words);
    }
    const BespokeView vertices = view_of(curve->vertices, curve->count, BESPOKE_COMPONENT_U32);
    return session_good(session, bespoke_session_add_curve(session->handle, &vertices, curve->closed, curve->weights[0],
                                                           curve->weights[1]), path);
}

bool curves_add(Session *session, const char *path) {
    Text text;
    if (!text_read(&text, path, &session->message)) {
        return false;
    }
    /* No line has more vertices than characters. */
    Curve curve = {.vertices = array_new(text.size, sizeof *curve.vertices)};
    bool good = curve.vertices != NULL || fail(&session->message, "%s: does not fit into memory", path);
    for (Line line = line_start(&text); good && line_next(&line, &text);) {
        good = line_add(session, &curve, &line, path);
    }
    free(curve.vertices);
    text_free(&text);
    return good;
}
