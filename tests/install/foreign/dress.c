/* Puts a sleeve, modelled around a bone, on a thicker arm. Ends with 0 where the result is verified and around it. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include <bespoke.h>

enum { AROUND = 10, SLEEVE_RINGS = 5, ARM_RINGS = 9 };

static const float joints[2][3] = {{0, -1, 0}, {0, 1, 0}};
static const uint32_t bone[1][2] = {{0, 1}};

static BespokeView view_of(const void *data, size_t count, uint32_t component) {
    const BespokeView view = {data, count, 0, component};
    return view;
}

/* An open tube about the y axis from -reach to reach. */
static void tube(float (*points)[3], uint32_t (*triangles)[3], uint32_t rings, double radius, double reach) {
    for (uint32_t k = 0; k < rings * AROUND; k++) {
        const double turn = 2.0 * 3.14159265358979 * (k % AROUND) / AROUND;
        points[k][0] = (float)(radius * sin(turn));
        points[k][1] = (float)(reach * (2.0 * (k / AROUND) / (rings - 1) - 1.0));
        points[k][2] = (float)(radius * cos(turn));
    }
    for (uint32_t k = 0; k < (rings - 1) * AROUND; k++) {
        const uint32_t next = k - k % AROUND + (k + 1) % AROUND;
        const uint32_t corners[2][3] = {{k, next, next + AROUND}, {k, next + AROUND, k + AROUND}};
        memcpy(triangles[2 * k], corners, sizeof corners);
    }
}

/* One mesh or one skeleton. */
typedef BespokeStatus (*Set)(BespokeSession *, const BespokeView *, const BespokeView *);

static BespokeStatus set_tube(BespokeSession *session, Set set, uint32_t rings, double radius, double reach) {
    float points[ARM_RINGS * AROUND][3];
    uint32_t triangles[2 * ARM_RINGS * AROUND][3];
    tube(points, triangles, rings, radius, reach);
    const BespokeView positions = view_of(points, rings * AROUND, BESPOKE_COMPONENT_F32);
    const BespokeView corners = view_of(triangles, 2 * (rings - 1) * AROUND, BESPOKE_COMPONENT_U32);
    return set(session, &positions, &corners);
}

static BespokeStatus set_bone(BespokeSession *session, Set set) {
    const BespokeView ends = view_of(joints, 2, BESPOKE_COMPONENT_F32);
    const BespokeView bones = view_of(bone, 1, BESPOKE_COMPONENT_U32);
    return set(session, &ends, &bones);
}

static BespokeStatus dress(BespokeSession *session) {
    BespokeOptions options;
    memset(&options, 0, sizeof options);
    options.struct_size = sizeof options;
    options.threads = 2;
    options.voxel_size = 0.05;
    BespokeStatus status = bespoke_session_set_options(session, &options);
    if (status == BESPOKE_STATUS_OK) status = set_tube(session, bespoke_session_set_garment, SLEEVE_RINGS, 0.3, 0.5);
    if (status == BESPOKE_STATUS_OK) status = set_tube(session, bespoke_session_set_target_avatar, ARM_RINGS, 0.4, 0.9);
    if (status == BESPOKE_STATUS_OK) status = set_bone(session, bespoke_session_set_source_skeleton);
    if (status == BESPOKE_STATUS_OK) status = set_bone(session, bespoke_session_set_target_skeleton);
    if (status == BESPOKE_STATUS_OK) status = bespoke_session_run(session);
    return status;
}

/* What is wrong with the result; null where nothing is. */
static const char *judge(const BespokeSession *session) {
    float points[SLEEVE_RINGS * AROUND][3];
    const BespokeBuffer room = {points, SLEEVE_RINGS * AROUND, 0, BESPOKE_COMPONENT_F32};
    size_t count = 0;
    BespokeReport report;
    BespokeIntersections found;
    memset(&report, 0, sizeof report);
    report.struct_size = sizeof report;
    if (bespoke_session_read_report(session, &report) != BESPOKE_STATUS_OK || report.is_verified != 1) {
        return "it was not verified";
    }
    if (bespoke_session_verify(session, BESPOKE_COMPONENT_F32, &found) != BESPOKE_STATUS_OK ||
        found.garment_garment != 0 || found.garment_avatar != 0) {
        return "it has intersections";
    }
    if (bespoke_session_read_garment_vertices(session, &room, &count) != BESPOKE_STATUS_OK ||
        count != SLEEVE_RINGS * AROUND) {
        return "it has another number of vertices";
    }
    for (size_t k = 0; k < count; k++) {
        /* The arm's flat sides are nearer to its axis than its edges. */
        if (!(hypot(points[k][0], points[k][2]) > 0.4 * cos(3.14159265358979 / AROUND))) {
            return "a vertex lies in the arm";
        }
    }
    return NULL;
}

int main(void) {
    BespokeSession *session = NULL;
    if (bespoke_abi_version() != BESPOKE_ABI_VERSION || bespoke_session_create(&session) != BESPOKE_STATUS_OK) {
        fprintf(stderr, "dress: no session\n");
        return 1;
    }
    const BespokeStatus status = dress(session);
    const char *fault = NULL;
    if (status == BESPOKE_STATUS_OK) {
        fault = judge(session);
    } else {
        char sentence[512] = "";
        bespoke_session_last_message(session, sentence, sizeof sentence, NULL);
        fprintf(stderr, "dress: %s: %s\n", bespoke_status_name(status), sentence);
    }
    if (fault != NULL) {
        fprintf(stderr, "dress: the result is bad: %s\n", fault);
    }
    bespoke_session_destroy(session);
    if (status != BESPOKE_STATUS_OK || fault != NULL) {
        return 1;
    }
    printf("dressed %d vertices, verified, by Bespoke %s\n", SLEEVE_RINGS * AROUND, bespoke_version_text());
    return 0;
}
