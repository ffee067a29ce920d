#include "renderer/core/mesh_io.h"
