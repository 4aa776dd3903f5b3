PetscErrorCode RegisterAll(void)
{
  PetscFunctionBegin;
  {
    static const PetscReal At[4] = {0, 0, 0, 0.5}, A[4] = {0, 0, 0.5, 0}, b[2] = {0, 1};
    PetscCall(TSARKIMEXRegister("imex-midpoint", 2, 2, At, b, NULL, A, b, NULL, NULL, NULL, 0,
                                NULL, NULL));
  }
  {
    const PetscReal A[3][3] = {{0, 0, 0}, {RC(1.0) / RC(2.0), 0, 0}, {-1, 2, 0}},
                    b[3] = {RC(1.0) / 6, RC(2.0) / 3, RC(1.0) / 6}, bembed[3] = {0, 1, 0};
    PetscCall(TSRKRegister("kutta3", 3, 3, &A[0][0], b, NULL, bembed, 0, NULL));
  }
  {
    const PetscReal gamma = 0.29289321881345254;
    const PetscReal At[2][2] = {{gamma, 0}, {1 - gamma, gamma}};
    PetscCall(TSDIRKRegister("sdirk2", 2, 2, &At[0][0], NULL, NULL, NULL, 0, NULL));
  }
  {
    PetscReal c[2] = {0.5, 0.5}, d[2] = {1.0, 0.0};
    PetscCall(TSBasicSymplecticRegister("verlet", 2, 2, c, d));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}
