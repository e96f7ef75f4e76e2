// The list of rays that a source may answer.
#ifndef REFLET_RAYS_WAITING_GLSL
#define REFLET_RAYS_WAITING_GLSL

layout(scalar) readonly buffer WaitingBlock {
    uint groups[3];
    uint count;
    RayItem items[];
} waiting;

#endif
