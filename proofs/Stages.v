(** * Stage vectors, and what maps them

    A stage vector is a family of rational numbers; only finitely many are not zero. Linear maps and
    products are lists of their coefficients, so they are linear and bilinear by construction. *)

From Coq Require Import QArith List Arith Lia.
Import ListNotations.
Open Scope Q_scope.

Definition V := nat -> Q.
Definition veq (x y : V) := forall i, x i == y i.
Definition add (x y : V) : V := fun i => x i + y i.
Definition scale (t : Q) (x : V) : V := fun i => t * x i.

(** Σ q x_j over the listed (j, q). *)
Fixpoint lin (terms : list (nat * Q)) (x : V) : Q :=
  match terms with [] => 0 | (j, q) :: r => q * x j + lin r x end.

(** Σ q x_a y_c over the listed (a, c, q). *)
Fixpoint bil (terms : list (nat * nat * Q)) (x y : V) : Q :=
  match terms with [] => 0 | (a, c, q) :: r => q * x a * y c + bil r x y end.

(** A matrix is a list of terms for each row; a product is one for each entry of the result. *)
Definition matrix := nat -> list (nat * Q).
Definition product := nat -> list (nat * nat * Q).
Definition app (A : matrix) (x : V) : V := fun i => lin (A i) x.
Definition mul (P : product) (x y : V) : V := fun i => bil (P i) x y.

Record linear (f : V -> Q) : Prop := {
  l_ext : forall x y, veq x y -> f x == f y;
  l_add : forall x y, f (add x y) == f x + f y;
  l_scale : forall t x, f (scale t x) == t * f x }.

Lemma veq_refl x : veq x x.
Proof. intros i; reflexivity. Qed.

Lemma lin_linear ts : linear (lin ts).
Proof.
  split; induction ts as [|[j q] r IH]; simpl; intros; try ring.
  - rewrite (H j), (IH x y H). reflexivity.
  - rewrite IH. unfold add. ring.
  - rewrite IH. unfold scale. ring.
Qed.

Lemma bil_left ts y : linear (fun x => bil ts x y).
Proof.
  split; induction ts as [|[[a c] q] r IH]; simpl; intros; try ring.
  - rewrite (H a), (IH x y0 H). reflexivity.
  - rewrite IH. unfold add. ring.
  - rewrite IH. unfold scale. ring.
Qed.

Lemma bil_right ts x : linear (bil ts x).
Proof.
  split; induction ts as [|[[a c] q] r IH]; simpl; intros; try ring.
  - rewrite (H c), (IH x0 y H). reflexivity.
  - rewrite IH. unfold add. ring.
  - rewrite IH. unfold scale. ring.
Qed.

Lemma app_ext A x y : veq x y -> veq (app A x) (app A y).
Proof. intros H i. apply (l_ext _ (lin_linear _)), H. Qed.
Lemma app_add A x y : veq (app A (add x y)) (add (app A x) (app A y)).
Proof. intros i. apply (l_add _ (lin_linear _)). Qed.
Lemma app_scale A t x : veq (app A (scale t x)) (scale t (app A x)).
Proof. intros i. apply (l_scale _ (lin_linear _)). Qed.

Lemma mul_left f P y : linear f -> linear (fun x => f (mul P x y)).
Proof.
  intros [E Ad Sc]; split; intros.
  - apply E. intros i. apply (l_ext _ (bil_left _ y)), H.
  - rewrite <- Ad. apply E. intros i. apply (l_add _ (bil_left _ y)).
  - rewrite <- Sc. apply E. intros i. apply (l_scale _ (bil_left _ y)).
Qed.

Lemma mul_right f P x : linear f -> linear (fun y => f (mul P x y)).
Proof.
  intros [E Ad Sc]; split; intros.
  - apply E. intros i. apply (l_ext _ (bil_right _ x)), H.
  - rewrite <- Ad. apply E. intros i. apply (l_add _ (bil_right _ x)).
  - rewrite <- Sc. apply E. intros i. apply (l_scale _ (bil_right _ x)).
Qed.

Lemma app_linear f A : linear f -> linear (fun x => f (app A x)).
Proof.
  intros [E Ad Sc]; split; intros.
  - apply E, app_ext, H.
  - rewrite <- Ad. apply E, app_add.
  - rewrite <- Sc. apply E, app_scale.
Qed.

Lemma scale_linear f n : linear f -> linear (fun x => f (scale n x)).
Proof.
  intros [E Ad Sc]; split; intros.
  - apply E. intros i. unfold scale. rewrite (H i). reflexivity.
  - rewrite <- Ad. apply E. intros i. unfold scale, add. ring.
  - rewrite <- Sc. apply E. intros i. unfold scale. ring.
Qed.

(** ** Affine hulls

    S lists points, with the weight 1, and directions, with the weight 0. v is in the hull of S, with
    the weight t, when f(v) = t c follows from f(s) = (weight of s) c on S, for all linear f. *)

Definition hull (S : list (V * Q)) (t : Q) (v : V) :=
  forall f c, linear f -> (forall s, In s S -> f (fst s) == snd s * c) -> f v == t * c.

Lemma hull_map S T A n t x : (forall s, In s S -> hull T (snd s) (app A (scale n (fst s)))) ->
  hull S t x -> hull T t (app A (scale n x)).
Proof.
  intros G H f c L K. apply (H (fun x => f (app A (scale n x)))).
  - apply (scale_linear (fun x => f (app A x))), app_linear, L.
  - intros s Hs. apply (G s Hs f c L K).
Qed.

Lemma hull_mul S1 S2 T P t t' x y :
  (forall a w, In a S1 -> In w S2 -> hull T (snd a * snd w) (mul P (fst a) (fst w))) ->
  hull S1 t x -> hull S2 t' y -> hull T (t * t') (mul P x y).
Proof.
  intros G Hx Hy f c L K. rewrite <- Qmult_assoc.
  apply (Hx (fun x => f (mul P x y))); [apply mul_left, L|]. intros a Ha.
  transitivity (t' * (snd a * c)); [|ring].
  apply (Hy (fun y => f (mul P (fst a) y))); [apply mul_right, L|]. intros w Hw.
  rewrite (G a w Ha Hw f c L K). ring.
Qed.
