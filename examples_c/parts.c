#include "parts.h"

#include <stdlib.h>
#include <string.h>

/* One option: its names, separated by commas, and the role of what has one of them. */
typedef struct Rule {
    const char *option;
    const char *names;
    uint16_t role;
} Rule;

#define RULE_COUNT 3

/* The next of the names, or false. */
static bool name_next(Word *name, const char **at) {
    while (**at == ',') {
        (*at)++;
    }
    const size_t length = strcspn(*at, ",");
    *name = (Word){*at, *at + length};
    *at += length;
    return length > 0;
}

static bool word_equals(Word a, Word b) {
    return a.end - a.begin == b.end - b.begin && memcmp(a.begin, b.begin, (size_t)(a.end - a.begin)) == 0;
}

/* Whether one of the words of the line, but for the first, is the name. */
static bool line_names(const Line *line, Word name) {
    const char *at = line->begin;
    Word word;
    bool found = false;
    for (bool is_first = true; word_next(&word, &at, line); is_first = false) {
        found = found || (!is_first && word_equals(word, name));
    }
    return found;
}

/* Gives the role to the triangles under the name. Returns whether the file has it. */
static bool mark(const Obj *obj, Word name, uint16_t role, uint16_t *roles) {
    /* Which of object, group and material has the name where the reader is. */
    bool has_name[3] = {false, false, false};
    bool found = false;
    size_t face = 0;
    size_t triangle = 0;
    for (Line line = line_start(&obj->text); line_next(&line, &obj->text);) {
        const char *at = line.begin;
        Word word;
        if (!word_next(&word, &at, &line)) {
            continue;
        }
        static const char *const keys[] = {"o", "g", "usemtl"};
        for (int k = 0; k < 3; k++) {
            if (word_is(word, keys[k])) {
                has_name[k] = line_names(&line, name);
                found = found || has_name[k];
            }
        }
        if (word_is(word, "f")) {
            for (uint32_t size = obj->face_sizes[face++]; size > 2; size--, triangle++) {
                if (has_name[0] || has_name[1] || has_name[2]) {
                    roles[triangle] = role;
                }
            }
        }
    }
    return found;
}

bool parts_set(Session *session, const Obj *avatar, const Options *options) {
    const Rule rules[RULE_COUNT] = {
        {"--body-groups", options->body_groups, BESPOKE_PART_ROLE_BODY},
        {"--collision-groups", options->collision_groups, BESPOKE_PART_ROLE_COLLISION},
        {"--ignore-groups", options->ignore_groups, BESPOKE_PART_ROLE_IGNORED},
    };
    uint16_t *roles = NULL;
    bool good = true;
    for (size_t k = 0; good && k < RULE_COUNT; k++) {
        if (rules[k].names == NULL) {
            continue;
        }
        if (roles == NULL) {
            roles = array_new(avatar->triangle_count, sizeof *roles);
            if (roles == NULL) {
                good = fail(&session->message, "%s: does not fit into memory", options->avatar);
                break;
            }
            memset(roles, 0, avatar->triangle_count * sizeof *roles);
        }
        const char *at = rules[k].names;
        for (Word name; good && name_next(&name, &at);) {
            if (!mark(avatar, name, rules[k].role, roles)) {
                good = fail(&session->message, "%s: has no object, group or material '%.*s', which %s names",
                            options->avatar, (int)(name.end - name.begin), name.begin, rules[k].option);
            }
        }
    }
    if (good && roles != NULL) {
        const BespokeView view = view_of(roles, avatar->triangle_count, BESPOKE_COMPONENT_U16);
        good = session_good(session, bespoke_session_set_avatar_parts(session->handle, &view), options->avatar);
    }
    free(roles);
    return good;
}
