#include "follow.h"

#include <stdlib.h>
#include <string.h>

/* A file of the same vertices as `base`, less the base: offsets. */
static bool add_morph(Session *session, const char *path, const Obj *base, const char *what,
                      BespokeStatus (*add)(BespokeSession *, const char *, const BespokeView *)) {
    Obj obj;
    if (!obj_read(&obj, path, &session->message)) {
        return false;
    }
    bool good = true;
    if (obj.vertex_count != base->vertex_count) {
        good = fail(&session->message, "%s: has %zu vertices, the %s has %zu; a morph is the same mesh in another shape",
                    path, obj.vertex_count, what, base->vertex_count);
    }
    for (size_t k = 0; good && k < 3 * obj.vertex_count; k++) {
        obj.positions[k] -= base->positions[k];
    }
    if (good) {
        const BespokeView offsets = view_of(obj.positions, obj.vertex_count, BESPOKE_COMPONENT_F32);
        good = session_good(session, add(session->handle, path, &offsets), path);
    }
    obj_free(&obj);
    return good;
}

static bool add_follower(Session *session, Obj *obj, const char *path) {
    if (!obj_read(obj, path, &session->message)) {
        return false;
    }
    const BespokeView positions = view_of(obj->positions, obj->vertex_count, BESPOKE_COMPONENT_F32);
    const BespokeView triangles = view_of(obj->triangles, obj->triangle_count, BESPOKE_COMPONENT_U32);
    return session_good(session, bespoke_session_add_follower(session->handle, &positions, &triangles), path);
}

bool follow_set(Session *session, Inputs *inputs, const Options *options) {
    for (size_t k = 0; k < options->garment_morphs.count; k++) {
        if (!add_morph(session, options->garment_morphs.paths[k], &inputs->garment, "garment",
                       bespoke_session_add_garment_morph)) {
            return false;
        }
    }
    for (size_t k = 0; k < options->target_morphs.count; k++) {
        if (!add_morph(session, options->target_morphs.paths[k], &inputs->avatar, "avatar",
                       bespoke_session_add_target_morph)) {
            return false;
        }
    }
    const size_t count = options->followers.count;
    inputs->followers = calloc(count > 0 ? count : 1, sizeof *inputs->followers);
    if (inputs->followers == NULL) {
        return fail(&session->message, "the followers do not fit into memory");
    }
    for (size_t k = 0; k < count; k++) {
        inputs->follower_count = k + 1; /* one that is refused is to be freed as well */
        if (!add_follower(session, &inputs->followers[k], options->followers.paths[k])) {
            return false;
        }
    }
    return true;
}

bool follow_solve(Session *session, const Options *options) {
    return options->target_morphs.count == 0 ||
           session_good(session, bespoke_session_solve_target_morphs(session->handle), NULL);
}

size_t follow_count(const Options *options) {
    return options->followers.count + options->garment_morphs.count + options->target_morphs.count;
}

/* x.obj: x.WHAT-0.obj; null without memory. */
static char *beside(const char *path, const char *what, size_t number) {
    static const char end[] = ".obj";
    const size_t length = strlen(path);
    const bool has_end = length > strlen(end) && strcmp(path + length - strlen(end), end) == 0;
    const size_t stem = has_end ? length - strlen(end) : length;
    const size_t size = stem + strlen(what) + 32;
    char *made = array_new(size, 1);
    if (made != NULL) {
        snprintf(made, size, "%.*s.%s-%zu%s", (int)stem, path, what, number, end);
    }
    return made;
}

static bool write_file(Output *output, Session *session, const Obj *obj, const float *positions, char *path) {
    const bool good = path != NULL && output_open(output, path, &session->message) &&
                      obj_write(obj, positions, NULL, NULL, output->file, &session->message) &&
                      output_finish(output, &session->message);
    if (path == NULL) {
        fail(&session->message, "the names of files do not fit into memory");
    }
    free(path);
    return good;
}

static bool write_follower(Output *output, Session *session, const Obj *obj, const char *garment, size_t number) {
    float *positions = array_new(obj->vertex_count, 3 * sizeof *positions);
    if (positions == NULL) {
        return fail(&session->message, "the vertices of a follower do not fit into memory");
    }
    const BespokeBuffer buffer = {positions, obj->vertex_count, 0, BESPOKE_COMPONENT_F32};
    const bool good =
        session_good(session, bespoke_session_read_follower_vertices(session->handle, (uint32_t)number, &buffer, NULL),
                     NULL) &&
        write_file(output, session, obj, positions, beside(garment, "follower", number));
    free(positions);
    return good;
}

typedef BespokeStatus (*ReadMorph)(const BespokeSession *, uint32_t, const BespokeBuffer *, size_t *);

/* The result with the morph at weight 1. */
static bool write_morph(Output *output, Session *session, const Obj *obj, const char *garment, const char *what,
                        size_t number, ReadMorph read) {
    const size_t count = obj->vertex_count;
    float *positions = array_new(count, 3 * sizeof *positions);
    float *offsets = array_new(count, 3 * sizeof *offsets);
    bool good = positions != NULL && offsets != NULL;
    if (!good) {
        fail(&session->message, "the vertices of a morph do not fit into memory");
    } else {
        const BespokeBuffer to_positions = {positions, count, 0, BESPOKE_COMPONENT_F32};
        const BespokeBuffer to_offsets = {offsets, count, 0, BESPOKE_COMPONENT_F32};
        const BespokeStatus status = read(session->handle, (uint32_t)number, &to_offsets, NULL);
        if (status == BESPOKE_STATUS_INVALID_STATE) {
            free(positions);
            free(offsets);
            return true; /* there is no answer, and a diagnostic said why */
        }
        good = session_good(session, status, NULL) &&
               session_good(session, bespoke_session_read_garment_vertices(session->handle, &to_positions, NULL), NULL);
    }
    for (size_t k = 0; good && k < 3 * count; k++) {
        positions[k] += offsets[k];
    }
    good = good && write_file(output, session, obj, positions, beside(garment, what, number));
    free(positions);
    free(offsets);
    return good;
}

bool follow_write(Output *outputs, Session *session, const Inputs *inputs, const Options *options) {
    for (size_t k = 0; k < inputs->follower_count; k++) {
        if (!write_follower(outputs++, session, &inputs->followers[k], options->output, k)) {
            return false;
        }
    }
    for (size_t k = 0; k < options->garment_morphs.count; k++) {
        if (!write_morph(outputs++, session, &inputs->garment, options->output, "garment-morph", k,
                         bespoke_session_read_garment_morph)) {
            return false;
        }
    }
    for (size_t k = 0; k < options->target_morphs.count; k++) {
        if (!write_morph(outputs++, session, &inputs->garment, options->output, "target-morph", k,
                         bespoke_session_read_target_morph)) {
            return false;
        }
    }
    return true;
}
