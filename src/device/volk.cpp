// Compiles the implementation of volk.
#define VOLK_IMPLEMENTATION
#include <volk.h>
