"""check_ceres_names.py finds what Ceres 2.2 has removed, and nothing else."""
import unittest

import check_ceres_names


class Faults(unittest.TestCase):
    def test_removed_names_are_found_with_their_place(self):
        text = "#include <ceres/local_parameterization.h>\n\nproblem.SetParameterization(x, p);\n"
        self.assertEqual(check_ceres_names.faults("a.cc", text), [
            "a.cc:1: ceres/local_parameterization.h is not in Ceres 2.2",
            "a.cc:3: SetParameterization is not in Ceres 2.2"])
        for name in ("ceres::CX_SPARSE", "options.use_postordering", "new SubsetParameterization"):
            self.assertEqual(len(check_ceres_names.faults("a.cc", name)), 1, name)

    def test_names_of_both_versions_are_not(self):
        for name in ("problem.SetManifold(x, m)", "ceres::SUITE_SPARSE", "// parameterization",
                     "ceres::EigenQuaternionManifold", "#include <ceres/manifold.h>"):
            self.assertEqual(check_ceres_names.faults("a.cc", name), [], name)


if __name__ == "__main__":
    unittest.main()
