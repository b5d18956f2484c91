#include <catena/flow/rigid_product.h>

namespace Catena
{
  using namespace dealii;

  RigidProduct::RigidProduct(const TrilinosWrappers::SparseMatrix &matrix)
  {
    const Epetra_CrsMatrix &epetra = matrix.trilinos_matrix();
    int                    *row_starts, *indices;
    double                 *values;
    const int               error =
      epetra.ExtractCrsDataPointers(row_starts, indices, values);
    AssertThrow(error == 0, ExcInternalError());
    entries = values;
    for (int i = 0; i < epetra.NumMyRows(); ++i)
      {
        if (row_starts[i + 1] == row_starts[i])
          continue;
        rows.push_back(i);
        for (int k = row_starts[i]; k < row_starts[i + 1]; ++k)
          columns.push_back(epetra.ColMap().GID(indices[k]));
        starts.push_back(columns.size());
      }
  }



  void
  RigidProduct::vmult_add(VectorType                &dst,
                          const std::vector<double> &motions) const
  {
    for (unsigned int i = 0; i < rows.size(); ++i)
      {
        double sum = 0.;
        for (unsigned int k = starts[i]; k < starts[i + 1]; ++k)
          sum += entries[k] * motions[columns[k]];
        dst.local_element(rows[i]) += sum;
      }
  }



  void
  RigidProduct::Tvmult_add(std::vector<double> &forces,
                           const VectorType    &src) const
  {
    for (unsigned int i = 0; i < rows.size(); ++i)
      {
        const double value = src.local_element(rows[i]);
        for (unsigned int k = starts[i]; k < starts[i + 1]; ++k)
          forces[columns[k]] += entries[k] * value;
      }
  }
} // namespace Catena
