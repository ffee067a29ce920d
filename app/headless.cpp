#include "app/headless.h"
