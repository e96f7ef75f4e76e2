// The path tracer.
#include "reference/reference.h"
