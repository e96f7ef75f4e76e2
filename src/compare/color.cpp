// Conversions between linear sRGB, YyCxCz and CIELAB.
#include "compare/color.h"

#include <cmath>

namespace reflet {

namespace {

// Columns are sRGB's red, green and blue primaries in CIE XYZ (D65), with the fractions from FLIP's definition; white
// is
// (0.95043, 1, 1.08890).
const mat3 linearToXyz(vec3(10135552.0 / 24577794.0, 2613072.0 / 12288897.0, 1425312.0 / 73733382.0),
                       vec3(8788810.0 / 24577794.0, 8788810.0 / 12288897.0, 8788810.0 / 73733382.0),
                       vec3(4435075.0 / 24577794.0, 887015.0 / 12288897.0, 70074185.0 / 73733382.0));
const mat3 xyzToLinear = glm::inverse(linearToXyz);
const vec3 white = linearToXyz * vec3(1.0F);

// CIELAB's cube root, linear below (6/29)³.
constexpr float labDelta = 6.0F / 29.0F;
constexpr float labCut = labDelta * labDelta * labDelta;
constexpr float labSlope = 1.0F / (3.0F * labDelta * labDelta);
constexpr float labOffset = 4.0F / 29.0F;

float labCurve(float t) {
    return t > labCut ? std::cbrt(t) : labSlope * t + labOffset;
}

float labCurveInverse(float f) {
    return f > labDelta ? f * f * f : (f - labOffset) / labSlope;
}

}  // namespace

float cieLuminance(const vec3& linear) {
    return linearToXyz[0].y * linear.x + linearToXyz[1].y * linear.y + linearToXyz[2].y * linear.z;
}

vec3 linearToOpponent(const vec3& linear) {
    const vec3 xyz = linearToXyz * linear / white;
    return {116.0F * xyz.y - 16.0F, 500.0F * (xyz.x - xyz.y), 200.0F * (xyz.y - xyz.z)};
}

vec3 opponentToLinear(const vec3& opponent) {
    const float y = (opponent.x + 16.0F) / 116.0F;
    return xyzToLinear * (white * vec3(y + opponent.y / 500.0F, y, y - opponent.z / 200.0F));
}

vec3 linearToLab(const vec3& linear) {
    const vec3 xyz = linearToXyz * linear / white;
    const float x = labCurve(xyz.x);
    const float y = labCurve(xyz.y);
    const float z = labCurve(xyz.z);
    return {116.0F * y - 16.0F, 500.0F * (x - y), 200.0F * (y - z)};
}

vec3 labToLinear(const vec3& lab) {
    const float y = (lab.x + 16.0F) / 116.0F;
    const vec3 xyz(labCurveInverse(y + lab.y / 500.0F), labCurveInverse(y), labCurveInverse(y - lab.z / 200.0F));
    return xyzToLinear * (white * xyz);
}

vec3 huntAdjusted(const vec3& lab) {
    return {lab.x, 0.01F * lab.x * lab.y, 0.01F * lab.x * lab.z};
}

float hyabDistance(const vec3& labA, const vec3& labB) {
    const vec3 d = labA - labB;
    return std::abs(d.x) + std::hypot(d.y, d.z);
}

}  // namespace reflet
