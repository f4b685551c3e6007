#include "diagnostics.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>

/* Lines that are printed. */
#define MOST_LINES 8

static const char *const kinds[] = {
    [BESPOKE_DIAGNOSTIC_KIND_SPLIT_VERTICES] = "split_vertices",
    [BESPOKE_DIAGNOSTIC_KIND_DUPLICATE_TRIANGLE] = "duplicate_triangle",
    [BESPOKE_DIAGNOSTIC_KIND_DEGENERATE_TRIANGLE] = "degenerate_triangle",
    [BESPOKE_DIAGNOSTIC_KIND_NON_MANIFOLD_EDGE] = "non_manifold_edge",
    [BESPOKE_DIAGNOSTIC_KIND_UNUSED_VERTEX] = "unused_vertex",
    [BESPOKE_DIAGNOSTIC_KIND_LOOSE_PIECE] = "loose_piece",
    [BESPOKE_DIAGNOSTIC_KIND_SELF_INTERSECTION] = "self_intersection",
    [BESPOKE_DIAGNOSTIC_KIND_NEAR_CONTACT] = "near_contact",
    [BESPOKE_DIAGNOSTIC_KIND_AVATAR_POKES] = "avatar_pokes",
    [BESPOKE_DIAGNOSTIC_KIND_COARSE_COORDINATES] = "coarse_coordinates",
    [BESPOKE_DIAGNOSTIC_KIND_RESULT_INTERSECTION] = "result_intersection",
    [BESPOKE_DIAGNOSTIC_KIND_PIN_NOT_REACHED] = "pin_not_reached",
    [BESPOKE_DIAGNOSTIC_KIND_RIGID_GROUP_BENT] = "rigid_group_bent",
};
static const char *const severities[] = {NULL, "note", "warning", "error"};
static const char *const subjects[] = {NULL, "garment", "target_avatar", "source_avatar", "source_skeleton", "target_skeleton"};
static const char *const elements[] = {NULL, "vertex", "triangle", "bone"};

/* A later library may know more than this program. */
#define NAME(list, index) ((index) < sizeof(list) / sizeof *(list) && (list)[index] != NULL ? (list)[index] : "other")

/* The caller frees it; null with a count of 0, or where there is no memory. */
static BespokeDiagnostic *read_all(const BespokeSession *session, size_t *count) {
    *count = 0;
    if (bespoke_session_read_diagnostics(session, NULL, 0, count) != BESPOKE_STATUS_OK || *count == 0) {
        return NULL;
    }
    BespokeDiagnostic *list = calloc(*count, sizeof *list);
    if (list != NULL && bespoke_session_read_diagnostics(session, list, *count, NULL) != BESPOKE_STATUS_OK) {
        free(list);
        list = NULL;
    }
    return list;
}

void diagnostics_print(const BespokeSession *session, FILE *file) {
    size_t count = 0;
    BespokeDiagnostic *list = read_all(session, &count);
    size_t shown = 0;
    for (size_t k = 0; list != NULL && k < count; k++) {
        if (list[k].severity != BESPOKE_SEVERITY_NOTE && shown++ < MOST_LINES) {
            fprintf(file, "%s: %s\n", NAME(severities, list[k].severity), list[k].sentence);
        }
    }
    if (shown > MOST_LINES) {
        fprintf(file, "... and %zu more; --report lists all\n", shown - MOST_LINES);
    }
    free(list);
}

static void write_text(FILE *file, const char *text) {
    putc('"', file);
    for (; *text != '\0'; text++) {
        const unsigned char byte = (unsigned char)*text;
        if (byte == '"' || byte == '\\') {
            putc('\\', file);
        }
        if (byte < 0x20) {
            fprintf(file, "\\u%04x", byte);
        } else {
            putc(byte, file);
        }
    }
    putc('"', file);
}

bool diagnostics_write(const BespokeSession *session, FILE *file, Message *message) {
    size_t count = 0;
    BespokeDiagnostic *list = read_all(session, &count);
    if (list == NULL && count > 0) {
        return fail(message, "the diagnostics do not fit into memory");
    }
    fputs("[", file);
    for (size_t k = 0; k < count; k++) {
        const BespokeDiagnostic *item = &list[k];
        fprintf(file, "%s\n    { \"kind\": \"%s\", \"severity\": \"%s\", \"elements\": [", k > 0 ? "," : "",
                NAME(kinds, item->kind), NAME(severities, item->severity));
        for (uint32_t e = 0; e < item->element_count; e++) {
            const BespokeElement *element = &item->elements[e];
            fputs(e > 0 ? ", { " : "{ ", file);
            if (element->subject >= BESPOKE_SUBJECT_LAYER) {
                fprintf(file, "\"of\": \"layer\", \"layer\": %" PRIu32, element->subject - BESPOKE_SUBJECT_LAYER);
            } else {
                fprintf(file, "\"of\": \"%s\"", NAME(subjects, element->subject));
            }
            fprintf(file, ", \"%s\": %" PRIu32 " }", NAME(elements, element->kind), element->index);
        }
        fputs("], ", file);
        if (isfinite(item->distance)) {
            fprintf(file, "\"distance\": %.9g, ", item->distance);
        }
        fputs("\"sentence\": ", file);
        write_text(file, item->sentence);
        fputs(" }", file);
    }
    fputs(count > 0 ? "\n  ]" : "]", file);
    free(list);
    return true;
}
