// The list of rays that a pass leaves to the next source.
#ifndef REFLET_RAYS_APPEND_GLSL
#define REFLET_RAYS_APPEND_GLSL

layout(scalar) buffer MissedBlock {
    uint groups[3];
    uint count;
    RayItem items[];
} missed;

// The first ray of each group of threads adds that group to the indirect dispatch.
void appendRay(WaitingRay ray) {
    uint index = atomicAdd(missed.count, 1u);
    missed.items[index] = packWaitingRay(ray);
    if (index % listGroupSize == 0u && index / listGroupSize < maxListGroups) {
        atomicAdd(missed.groups[0], 1u);
    }
}

#endif
