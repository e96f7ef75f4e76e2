// Values of a host that are not finite count as 0.
#ifndef REFLET_FINITE_GLSL
#define REFLET_FINITE_GLSL

bool finite(float x) { return !isnan(x) && !isinf(x); }
bool finite(vec3 v) { return finite(v.x) && finite(v.y) && finite(v.z); }
float orZero(float x) { return finite(x) ? x : 0.0; }

#endif
