#include "materials/material.h"
