#include "solver/closed_form.h"
