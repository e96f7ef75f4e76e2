// The tests' own volk: a library must get along with a host that has one.
#define VOLK_IMPLEMENTATION
#include <volk.h>
