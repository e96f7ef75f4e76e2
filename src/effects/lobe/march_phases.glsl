// Rays that have not ended after a number of steps, for the next pass: in a wave, or a CPU's vector, all wait for the longest
// ray, and most rays are much shorter. There they go on side by side, with the same result to the bit.
#ifndef REFLET_MARCH_PHASES_GLSL
#define REFLET_MARCH_PHASES_GLSL

#include "effects/lobe/rays.glsl"

layout(constant_id = 35) const uint continues = 0u;  // 1: goes on with `unfinished`
layout(constant_id = 36) const uint collects = 0u;   // 1: appends rays that have not ended to `longer`

layout(scalar) readonly buffer UnfinishedBlock {
    uint groups[3];
    uint count;
    UnfinishedRay items[];
} unfinished;
layout(scalar) buffer LongerBlock {
    uint groups[3];
    uint count;
    UnfinishedRay items[];
} longer;

const uint behindBit = 0x80000000u;

UnfinishedRay packUnfinished(RayItem ray, HizState s) {
    uint place = packSlot(ivec3(s.pixel, s.level)) | (s.behind ? behindBit : 0u);
    uint first = floatBitsToUint(s.first) | (s.occluded ? 0x80000000u : 0u);  // in the sign
    return UnfinishedRay(ray, place, first, s.clear);
}

HizState unpackUnfinished(UnfinishedRay ray) {
    ivec3 place = unpackSlot(ray.place & ~behindBit);
    return HizState(place.xy, place.z, uintBitsToFloat(ray.first & 0x7fffffffu), ray.clear, (ray.place & behindBit) != 0u,
                    (ray.first & 0x80000000u) != 0u);
}

uint unfinishedCount() { return min(unfinished.count, uint(unfinished.items.length())); }

// Returns false if there is no room.
bool appendUnfinished(RayItem ray, HizState state) {
    uint index = atomicAdd(longer.count, 1u);
    if (index >= uint(longer.items.length())) {
        return false;
    }
    longer.items[index] = packUnfinished(ray, state);
    if (index % listGroupSize == 0u && index / listGroupSize < maxListGroups) {
        atomicAdd(longer.groups[0], 1u);
    }
    return true;
}

// Marches by the method of the settings. Returns marchUnfinished if the ray is in `longer`.
MarchResult marchPhase(RayItem item, HizState state, MarchRay ray, MarchOptions o, MarchView view) {
    if (method != TraceMethod_hiz) {
        return marchBy(method, ray, o, view);
    }
    uint from = continues != 0u ? params.firstStep : 0u;
    uint end = collects != 0u ? params.endStep : o.maxSteps;
    MarchResult hit;
    bool again = true;
    while (again) {
        hit = marchHizOn(state, from, end, ray, o, view);
        again = collects != 0u && hit.outcome == marchUnfinished && !appendUnfinished(item, state);
        from = end;
        end = o.maxSteps;
    }
    return hit;
}

#endif
