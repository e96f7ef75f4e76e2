// Taps of a blur: on a disk, each turned by the golden angle from the one before, so that any number of them covers it evenly.
#ifndef REFLET_BLUR_DISK_GLSL
#define REFLET_BLUR_DISK_GLSL

// The next tap's direction, as long as this one's.
vec2 nextSpoke(vec2 spoke) {
    const vec2 goldenTurn = vec2(-0.737368878, 0.675490294);  // cosine and sine of the golden angle
    return vec2(spoke.x * goldenTurn.x - spoke.y * goldenTurn.y, spoke.x * goldenTurn.y + spoke.y * goldenTurn.x);
}

// The first tap's direction on a disk of this many pixels, turned by an angle. Its length is that of one tap's share of the disk.
vec2 firstSpoke(float radius, int taps, float turn) {
    return radius * inversesqrt(float(taps)) * vec2(cos(turn), sin(turn));
}

// Distance of a tap from the middle, in lengths of the spokes.
float tapReach(int tap) { return sqrt(float(tap) + 0.5); }

// The first tap's weight; each tap's is its square times that of the one before: exp(-1.5 reach²), with reach 1 at the disk's edge.
float firstTapWeight(int taps) { return exp(-0.75 / float(taps)); }

#endif
