// Uniform values that decide branches and loops.
//
// Mesa's CPU driver up to 22.3 compiles a shader anew, at each draw and dispatch, if values of a uniform block alone decide a branch
// or the end of a loop, and never frees what it compiled: 1 to 30 ms and about 0.5 MB each time. A value that may depend on where
// the pixel is, is left alone; these never do.
#ifndef REFLET_NOT_INLINED_GLSL
#define REFLET_NOT_INLINED_GLSL

// In compute shaders; invocation: gl_GlobalInvocationID.x.
uint notInlined(uint value, uint invocation) { return invocation == 0xffffffffu ? 0u : value; }

// In fragment shaders; pixel: gl_FragCoord.
uint notInlined(uint value, vec4 pixel) { return pixel.x < -1.0 ? 0u : value; }

#endif
