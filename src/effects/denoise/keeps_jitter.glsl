// Reflections whose means over frames would lose detail of a pixel's size.
#ifndef REFLET_DENOISE_KEEPS_JITTER_GLSL
#define REFLET_DENOISE_KEEPS_JITTER_GLSL

// Up to the first roughness a reflection may show detail of a pixel's size, above the second none.
const float mirrorLike = 0.05;
const float blurred = 0.15;

// How much the light is of this frame's subpixel jitter, so that temporal antialiasing keeps its samples apart; else of the
// pixel's whole area. 0..1.
float keepsJitter(float roughness) { return 1.0 - smoothstep(mirrorLike, blurred, roughness); }

#endif
