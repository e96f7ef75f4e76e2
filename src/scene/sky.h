// Made environments: a clear sky with its sun, and a photographer's studio. Pictures for scenes that bring no light.
#pragma once

#include "base/image_file.h"
#include "base/math.h"

namespace reflet {

/// A clear daylight sky as an equirectangular image, and the sun that belongs to it.
/// (A. J. Preetham, P. Shirley, B. Smits, A Practical Analytic Model for Daylight, SIGGRAPH 1999: sky luminance and
/// chromaticity, and the sun's attenuation by air, aerosol and ozone; turbidity 3.) Below the horizon: ground of albedo
/// 0.25, lit by both. The ratio of sun to sky is the model's.
struct Sky {
    /// Largest luminance of the sun's irradiance [W/m²]: all values are scaled so that a white surface in the light of
    /// both has a radiance of about 1, and the horizontal surface under a high sun looks neutral (white balance).
    /// Colours have half the model's saturation.
    static constexpr float sunLuminance = 3.0F;

    /// "R" "G" "B", 1024x512 [W/(m² sr)]; without the sun's disk. The sun's azimuth is the image's centre.
    FloatImage image;
    vec3 sunIrradiance{0.0F};  ///< on a surface that faces the sun [W/m²]; 0 with the sun below the horizon
};

/// elevation: of the sun above the horizon, -pi/2 to pi/2. The luminance of the sun's irradiance is sunLuminance from
/// 10 degrees on and falls below. Under the horizon the sky of sunset fades as twilight does, down to 18 degrees.
Sky makeSky(float elevation);

/// A studio of soft boxes on a grey surround: a large key light at the upper left behind the camera, a weaker fill at
/// the right, a strip behind the object, and one overhead. The camera looks along the image's centre. "R" "G" "B",
/// 1024x512 [W/(m² sr)].
FloatImage makeStudio();

/// Mean radiance over all directions.
vec3 meanRadiance(const FloatImage& image);

}  // namespace reflet
