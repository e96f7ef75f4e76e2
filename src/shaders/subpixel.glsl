// Devices move vertices to a grid below the pixel before they rasterise, and interpolate depth over the moved triangle.
#ifndef REFLET_SUBPIXEL_GLSL
#define REFLET_SUBPIXEL_GLSL

// Bound of the distance of a point that is reconstructed from depth to the surface's plane, in widths of its pixel: GPUs
// have 8 bits below the pixel (VkPhysicalDeviceLimits::subPixelPrecisionBits), so a vertex moves by up to half a step
// along each axis.
const float subpixel = 1.0 / 256.0;

#endif
