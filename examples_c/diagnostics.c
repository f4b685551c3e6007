#include "diagnostics.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "json.h"

/* Lines that are printed, in all and of one kind, so that many of one do not hide the others. */
#define MOST_LINES 8
#define MOST_OF_A_KIND 3

static const char *const kinds[] = {
    [BESPOKE_DIAGNOSTIC_KIND_SPLIT_VERTICES] = "split_vertices",
    [BESPOKE_DIAGNOSTIC_KIND_DUPLICATE_TRIANGLE] = "duplicate_triangle",
    [BESPOKE_DIAGNOSTIC_KIND_DEGENERATE_TRIANGLE] = "degenerate_triangle",
    [BESPOKE_DIAGNOSTIC_KIND_NON_MANIFOLD_EDGE] = "non_manifold_edge",
    [BESPOKE_DIAGNOSTIC_KIND_UNUSED_VERTEX] = "unused_vertex",
    [BESPOKE_DIAGNOSTIC_KIND_LOOSE_PIECE] = "loose_piece",
    [BESPOKE_DIAGNOSTIC_KIND_SELF_INTERSECTION] = "self_intersection",
    [BESPOKE_DIAGNOSTIC_KIND_NEAR_CONTACT] = "near_contact",
    [BESPOKE_DIAGNOSTIC_KIND_AVATAR_PENETRATES] = "avatar_penetrates",
    [BESPOKE_DIAGNOSTIC_KIND_COARSE_COORDINATES] = "coarse_coordinates",
    [BESPOKE_DIAGNOSTIC_KIND_RESULT_INTERSECTION] = "result_intersection",
    [BESPOKE_DIAGNOSTIC_KIND_PIN_NOT_REACHED] = "pin_not_reached",
    [BESPOKE_DIAGNOSTIC_KIND_RIGID_GROUP_BENT] = "rigid_group_bent",
    [BESPOKE_DIAGNOSTIC_KIND_INFLATION_BLOCKED] = "inflation_blocked",
    [BESPOKE_DIAGNOSTIC_KIND_JOINT_MISPLACED] = "joint_misplaced",
    [BESPOKE_DIAGNOSTIC_KIND_POSE_BLOCKED] = "pose_blocked",
    [BESPOKE_DIAGNOSTIC_KIND_FOLLOWER_INTERSECTS] = "follower_intersects",
    [BESPOKE_DIAGNOSTIC_KIND_MORPH_NOT_SOLVED] = "morph_not_solved",
    [BESPOKE_DIAGNOSTIC_KIND_MORPH_INTERSECTS] = "morph_intersects",
    [BESPOKE_DIAGNOSTIC_KIND_JOINTS_UNSURE] = "joints_unsure",
    [BESPOKE_DIAGNOSTIC_KIND_SOLVED_POSED] = "solved_posed",
    [BESPOKE_DIAGNOSTIC_KIND_SOURCE_DRESSED] = "source_dressed",
    [BESPOKE_DIAGNOSTIC_KIND_WEIGHTS_CONTRADICT] = "weights_contradict",
    [BESPOKE_DIAGNOSTIC_KIND_BONES_UNCLEAR] = "bones_unclear",
    [BESPOKE_DIAGNOSTIC_KIND_FOREIGN_PART] = "foreign_part",
    [BESPOKE_DIAGNOSTIC_KIND_SETTINGS_ADJUSTED] = "settings_adjusted",
    [BESPOKE_DIAGNOSTIC_KIND_KEPT_TOGETHER] = "kept_together",
    [BESPOKE_DIAGNOSTIC_KIND_WELDED_NEAR] = "welded_near",
    [BESPOKE_DIAGNOSTIC_KIND_T_JUNCTIONS] = "t_junctions",
    [BESPOKE_DIAGNOSTIC_KIND_RIMS_NOT_FOUND] = "rims_not_found",
    [BESPOKE_DIAGNOSTIC_KIND_CARRIED_PIECE] = "carried_piece",
    [BESPOKE_DIAGNOSTIC_KIND_UNTANGLED] = "untangled",
    [BESPOKE_DIAGNOSTIC_KIND_OPENING_CAP] = "opening_cap",
    [BESPOKE_DIAGNOSTIC_KIND_LIMB_MISPLACED] = "limb_misplaced",
    [BESPOKE_DIAGNOSTIC_KIND_PIECE_RESIZED] = "piece_resized",
    [BESPOKE_DIAGNOSTIC_KIND_NOT_CONVERGED] = "not_converged",
    [BESPOKE_DIAGNOSTIC_KIND_UNIT_MISMATCH] = "unit_mismatch",
    [BESPOKE_DIAGNOSTIC_KIND_FACING_MISMATCH] = "facing_mismatch",
    [BESPOKE_DIAGNOSTIC_KIND_SIDES_SWAPPED] = "sides_swapped",
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
    if (list == NULL) {
        return NULL;
    }
    list->struct_size = sizeof *list;
    if (bespoke_session_read_diagnostics(session, list, *count, NULL) != BESPOKE_STATUS_OK) {
        free(list);
        list = NULL;
    }
    return list;
}

/* Whether item k says something that fewer than MOST_OF_A_KIND before it have said. */
static bool is_worth_a_line(const BespokeDiagnostic *list, size_t k) {
    size_t alike = 0;
    for (size_t before = 0; before < k; before++) {
        if (list[before].kind == list[k].kind && list[before].severity == list[k].severity) {
            alike += strcmp(list[before].message, list[k].message) == 0 ? MOST_OF_A_KIND : 1;
        }
    }
    return alike < MOST_OF_A_KIND;
}

void diagnostics_print(const BespokeSession *session, uint32_t least, FILE *file) {
    size_t count = 0;
    BespokeDiagnostic *list = read_all(session, &count);
    size_t lines = 0, others = 0;
    /* The worst first. */
    for (uint32_t severity = BESPOKE_SEVERITY_ERROR; list != NULL && severity >= least && severity > 0; severity--) {
        for (size_t k = 0; k < count; k++) {
            if (list[k].severity != severity) {
                continue;
            }
            if (lines < MOST_LINES && is_worth_a_line(list, k)) {
                fprintf(file, "%s: %s\n", NAME(severities, severity), list[k].message);
                lines++;
            } else {
                others++;
            }
        }
    }
    if (others > 0) {
        fprintf(file, "... and %zu more; --report lists all\n", others);
    }
    free(list);
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
            if (element->subject >= BESPOKE_SUBJECT_FOLLOWER) {
                fprintf(file, "\"of\": \"follower\", \"follower\": %" PRIu32, element->subject - BESPOKE_SUBJECT_FOLLOWER);
            } else if (element->subject >= BESPOKE_SUBJECT_LAYER) {
                fprintf(file, "\"of\": \"layer\", \"layer\": %" PRIu32, element->subject - BESPOKE_SUBJECT_LAYER);
            } else {
                fprintf(file, "\"of\": \"%s\"", NAME(subjects, element->subject));
            }
            fprintf(file, ", \"%s\": %" PRIu32 " }", NAME(elements, element->kind), element->index);
        }
        fputs("], \"distance\": ", file);
        json_number(file, item->distance);
        fputs(", \"message\": ", file);
        json_text(file, item->message);
        fputs(" }", file);
    }
    fputs(count > 0 ? "\n  ]" : "]", file);
    free(list);
    return true;
}
