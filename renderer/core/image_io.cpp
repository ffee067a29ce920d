#include "renderer/core/image_io.h"
