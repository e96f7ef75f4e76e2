/* The host's camera and sun. */
#include "host.h"

#include <math.h>
#include <string.h>

/* ---- matrices: column-major, element (row, column) is m[4 * column + row] ---- */

static void multiply(float* out, const float* a, const float* b) {
    for (int c = 0; c < 4; ++c) {
        for (int r = 0; r < 4; ++r) {
            float sum = 0.0F;
            for (int k = 0; k < 4; ++k) sum += a[4 * k + r] * b[4 * c + k];
            out[4 * c + r] = sum;
        }
    }
}

static void normalize3(float* v) {
    const float length = sqrtf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int i = 0; i < 3; ++i) v[i] /= length;
}

static void cross3(float* out, const float* a, const float* b) {
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/* Right-handed: the camera looks along -Z of view space. */
static void look_at(float* m, const float* eye, const float* target) {
    float z[3] = {eye[0] - target[0], eye[1] - target[1], eye[2] - target[2]};
    const float up[3] = {0.0F, 1.0F, 0.0F};
    float x[3], y[3];
    normalize3(z);
    cross3(x, up, z);
    normalize3(x);
    cross3(y, z, x);
    for (int i = 0; i < 3; ++i) {
        m[4 * i] = x[i];
        m[4 * i + 1] = y[i];
        m[4 * i + 2] = z[i];
        m[4 * i + 3] = 0.0F;
    }
    m[12] = -(x[0] * eye[0] + x[1] * eye[1] + x[2] * eye[2]);
    m[13] = -(y[0] * eye[0] + y[1] * eye[1] + y[2] * eye[2]);
    m[14] = -(z[0] * eye[0] + z[1] * eye[1] + z[2] * eye[2]);
    m[15] = 1.0F;
}

/* Standard depth, 0 at the near plane; y down in clip space. */
static void perspective(float* m, float tangent, float aspect, float near, float far) {
    memset(m, 0, 16 * sizeof(float));
    m[0] = 1.0F / (tangent * aspect);
    m[5] = -1.0F / tangent;
    m[10] = far / (near - far);
    m[11] = -1.0F;
    m[14] = near * far / (near - far);
}

static void orthographic(float* m, float half, float near, float far) {
    memset(m, 0, 16 * sizeof(float));
    m[0] = 1.0F / half;
    m[5] = -1.0F / half;
    m[10] = 1.0F / (near - far);
    m[14] = near / (near - far);
    m[15] = 1.0F;
}

void host_camera(Host* h, Camera* c, const Camera* before, const float jitter[2], float angle) {
    const float eye[3] = {6.2F * sinf(angle), 2.2F, 6.2F * cosf(angle)};
    const float target[3] = {0.0F, 0.9F, 0.0F};
    look_at(c->world_to_view, eye, target);
    perspective(h->view_to_clip, 0.45F, (float)h->width / (float)h->height, 0.1F, 50.0F);
    multiply(c->world_to_clip_plain, h->view_to_clip, c->world_to_view);
    float jittered[16];
    memcpy(jittered, h->view_to_clip, sizeof jittered);
    for (int i = 0; i < 4; ++i) { /* x += shift * w */
        jittered[4 * i] -= 2.0F * jitter[0] / (float)h->width * h->view_to_clip[4 * i + 3];
        jittered[4 * i + 1] -= 2.0F * jitter[1] / (float)h->height * h->view_to_clip[4 * i + 3];
    }
    multiply(c->world_to_clip, jittered, c->world_to_view);
    const bool still = before != NULL && memcmp(c->world_to_view, before->world_to_view, sizeof c->world_to_view) == 0;
    h->rest = still ? h->rest + 1 : 0;
    memcpy(c->previous_world_to_clip, before != NULL ? before->world_to_clip_plain : c->world_to_clip_plain,
           sizeof c->world_to_clip);
    float to_sun[3] = {0.45F, 1.0F, 0.55F};
    normalize3(to_sun);
    const float from[3] = {10.0F * to_sun[0], 10.0F * to_sun[1], 10.0F * to_sun[2]};
    const float center[3] = {0.0F, 0.0F, 0.0F};
    float sun_view[16], sun_clip[16];
    look_at(sun_view, from, center);
    orthographic(sun_clip, 5.5F, 1.0F, 20.0F);
    multiply(c->world_to_sun, sun_clip, sun_view);
    memcpy(c->to_sun, to_sun, sizeof to_sun);
    const float sky[4] = {0.35F, 0.45F, 0.6F, 0.0F};
    memcpy(c->sky, sky, sizeof sky);
}
