#include "renderer/core/mesh.h"
