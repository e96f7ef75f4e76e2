// A thread's column of pixels. The includer defines resolve(pixel, row above, its row, row below).
void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.x, gl_GlobalInvocationID.y * temporalColumn);
    if (any(greaterThanEqual(uvec2(pixel), params.size))) {
        return;
    }
    int end = min(pixel.y + int(temporalColumn), int(params.size.y));
    Row above = loadRow(pixel - ivec2(0, 1));
    Row row = loadRow(pixel);
    for (; pixel.y < end; ++pixel.y) {
        Row below = loadRow(pixel + ivec2(0, 1));
        resolve(pixel, above, row, below);
        above = row;
        row = below;
    }
}
