// Taps of a blur: on a disk, each turned by the golden angle from the one before, so that any number of them covers it evenly.
#ifndef REFLET_BLUR_DISK_GLSL
#define REFLET_BLUR_DISK_GLSL

// The next tap's direction, as long as this one's.
vec2 nextSpoke(vec2 spoke) {
    const vec2 goldenTurn = vec2(-0.737368878, 0.675490294);  // cosine and sine of the golden angle
    return vec2(spoke.x * goldenTurn.x - spoke.y * goldenTurn.y, spoke.x * goldenTurn.y + spoke.y * goldenTurn.x);
}

// Distance of a tap from the middle, 0 to 1.
float tapReach(int tap, int taps) { return sqrt((float(tap) + 0.5) / float(taps)); }

// A tap's weight, exp(-1.5 reach²), and that of the next one.
float firstTapWeight(int taps) { return exp(-0.75 / float(taps)); }
float nextTapWeight(float weight, int taps) { return weight * exp(-1.5 / float(taps)); }

#endif
