/* tube.h: two tubes, a skeleton, and the calls from a new session to the result. */
#include "tube.h"

#include <dlfcn.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bespoke.h"

#define AROUND 16
#define RINGS 15

void tube_fail(const char *format, ...) {
    va_list values;
    va_start(values, format);
    vfprintf(stderr, format, values);
    va_end(values);
    fputc('\n', stderr);
    exit(1);
}

void *tube_open(const char *path, int flags) {
    void *library = dlopen(path, flags);
    if (library == NULL) {
        tube_fail("%s", dlerror());
    }
    return library;
}

static void *find(void *library, const char *name) {
    void *function = dlsym(library, name);
    if (function == NULL) {
        tube_fail("%s", dlerror());
    }
    return function;
}

/* An open tube around the y axis; as many triangles come out as are returned. */
static size_t tube(float radius, float reach, float (*points)[3], uint32_t (*triangles)[3]) {
    /* Turned step by step by a sixteenth: the system's sines have other last bits on other systems. */
    double direction[AROUND][2] = {{0.0, 1.0}};
    for (int k = 1; k < AROUND; k++) {
        const double turn[2] = {0.3826834323650898, 0.9238795325112867}, *before = direction[k - 1];
        direction[k][0] = before[0] * turn[1] + before[1] * turn[0];
        direction[k][1] = before[1] * turn[1] - before[0] * turn[0];
    }
    size_t count = 0;
    for (uint32_t k = 0; k < RINGS * AROUND; k++) {
        points[k][0] = radius * (float)direction[k % AROUND][0];
        points[k][1] = reach * (2.0f * (float)(k / AROUND) / (RINGS - 1) - 1.0f);
        points[k][2] = radius * (float)direction[k % AROUND][1];
        if (k / AROUND + 1 < RINGS) {
            const uint32_t next = k / AROUND * AROUND + (k + 1) % AROUND;
            const uint32_t corners[2][3] = {{k, next, next + AROUND}, {k, next + AROUND, k + AROUND}};
            memcpy(triangles[count], corners, sizeof corners);
            count += 2;
        }
    }
    return count;
}

#define TRY(name, ...) ((__typeof__(&name))find(library, #name))(__VA_ARGS__)

#define CALL(name, ...) \
    do { \
        const BespokeStatus status = TRY(name, __VA_ARGS__); \
        if (status != BESPOKE_STATUS_OK) { \
            tube_fail(#name ": status %u", (unsigned)status); \
        } \
    } while (0)

uint64_t tube_dress(void *library) {
    uint64_t hash = 0;
    char message[TUBE_MESSAGE];
    const unsigned status = tube_try(library, 2, &hash, message);
    if (status != BESPOKE_STATUS_OK) {
        tube_fail("status %u: %s", status, message);
    }
    return hash;
}

unsigned tube_try(void *library, unsigned thread_count, uint64_t *hash, char message[TUBE_MESSAGE]) {
    float garment[RINGS * AROUND][3], avatar[RINGS * AROUND][3], result[RINGS * AROUND][3];
    uint32_t triangles[2 * RINGS * AROUND][3];
    tube(0.3f, 0.55f, garment, triangles);
    const size_t triangle_count = tube(0.4f, 0.9f, avatar, triangles);
    const float joints[3][3] = {{0.0f, -1.0f, 0.0f}, {0.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}};
    const uint32_t bones[2][2] = {{0, 1}, {1, 2}};

    const BespokeView garment_view = {garment, RINGS * AROUND, 0, BESPOKE_COMPONENT_F32};
    const BespokeView avatar_view = {avatar, RINGS * AROUND, 0, BESPOKE_COMPONENT_F32};
    const BespokeView triangle_view = {triangles, triangle_count, 0, BESPOKE_COMPONENT_U32};
    const BespokeView joint_view = {joints, 3, 0, BESPOKE_COMPONENT_F32};
    const BespokeView bone_view = {bones, 2, 0, BESPOKE_COMPONENT_U32};
    const BespokeBuffer buffer = {result, RINGS * AROUND, 0, BESPOKE_COMPONENT_F32};
    BespokeOptions options = {.struct_size = sizeof options, .threads = thread_count, .voxel_size = 0.02};
    BespokeSession *session = NULL;
    CALL(bespoke_session_create, &session);
    CALL(bespoke_session_set_options, session, &options);
    CALL(bespoke_session_set_garment, session, &garment_view, &triangle_view);
    CALL(bespoke_session_set_source_skeleton, session, &joint_view, &bone_view);
    CALL(bespoke_session_set_target_avatar, session, &avatar_view, &triangle_view);
    CALL(bespoke_session_set_target_skeleton, session, &joint_view, &bone_view);
    message[0] = '\0';
    const BespokeStatus outcome = TRY(bespoke_session_run, session);
    if (outcome == BESPOKE_STATUS_OK) {
        CALL(bespoke_session_read_garment_vertices, session, &buffer, NULL);
    } else {
        CALL(bespoke_session_last_message, session, message, TUBE_MESSAGE, NULL);
    }
    CALL(bespoke_session_destroy, session);
    if (outcome != BESPOKE_STATUS_OK) {
        return outcome;
    }

    *hash = 0xcbf29ce484222325u;
    const unsigned char *bytes = (const unsigned char *)result;
    for (size_t k = 0; k < sizeof result; k++) {
        *hash = (*hash ^ bytes[k]) * 0x100000001b3u;
    }
    return BESPOKE_STATUS_OK;
}
