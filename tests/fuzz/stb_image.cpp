// stb_image's decoder, compiled with sanitizers and coverage for the targets png and jpeg. The linker takes it before
// the packaged library, which has neither.
#define STB_IMAGE_IMPLEMENTATION
#include <stb/stb_image.h>
