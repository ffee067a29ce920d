#include "renderer/core/camera.h"
