#include "solver/radiosity.h"
