#include <Eigen/SparseCore>
