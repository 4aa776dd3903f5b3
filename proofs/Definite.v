(** * Weights that are definite, by computation

    b_l(v ⊙ v) is a quadratic form in the coordinates of v, with values in ℚ(θ). A linear map λ of
    ℚ(θ) to ℚ makes it one over ℚ: if elimination finds that one positive definite, b_l(v ⊙ v) = 0
    only for v = 0. Over ℚ that decides stages in ℚ[x]/(M) too. Over a larger field there is such a λ
    only if all roots θ are real. *)

From Coq Require Import QArith List Arith Lia Bool.
From Gark Require Import Stages Methods Sums Check Pairs Products Conditions.
Import ListNotations.
Open Scope Q_scope.

(** ** Positive definite matrices *)

Definition at_ (G : list (list Q)) i j := nth j (nth i G []) 0.
Definition form n G (v : V) : Q :=
  sum (seq 0 n) (fun i => sum (seq 0 n) (fun j => at_ G i j * v i * v j)).

Fixpoint positive_definite (n : nat) (G : list (list Q)) : bool :=
  match n with
  | O => true
  | S n =>
      let d := at_ G 0 0 in
      negb (Qle_bool d 0) && all n (fun i => Qeq_bool (at_ G (S i) 0) (at_ G 0 (S i))) &&
      positive_definite n (table n (fun i => table n (fun j =>
        Qred (at_ G (S i) (S j) - at_ G (S i) 0 * at_ G 0 (S j) / d))))
  end.

Lemma sum_S n f : sum (seq 0 (S n)) f == f 0%nat + sum (seq 0 n) (fun i => f (S i)).
Proof.
  cbn [seq]. rewrite <- seq_shift. unfold sum. cbn [map fold_right]. rewrite map_map. reflexivity.
Qed.
Lemma square_nonnegative q : 0 <= q * q.
Proof. unfold Qle. simpl. nia. Qed.
Lemma sum_is_0 p q : 0 <= p -> 0 <= q -> p + q == 0 -> p == 0 /\ q == 0.
Proof.
  intros P Q E. assert (Ep : p == - q) by (rewrite <- (Qplus_0_r p), <- (Qplus_opp_r q) at 1;
    rewrite Qplus_assoc, E; ring).
  assert (L : p <= 0) by (rewrite Ep; apply (Qopp_le_compat 0), Q).
  assert (Z : p == 0) by (apply Qle_antisym; assumption). split; [exact Z|].
  rewrite Z, Qplus_0_l in E. exact E.
Qed.

(** The form is that of the complement, and a square. *)
Lemma form_S n G v : (forall i, (i < n)%nat -> at_ G (S i) 0 == at_ G 0 (S i)) -> ~ at_ G 0 0 == 0 ->
  let s := at_ G 0 0 * v 0%nat + sum (seq 0 n) (fun i => at_ G 0 (S i) * v (S i)) in
  form (S n) G v == s * s / at_ G 0 0 + form n (table n (fun i => table n (fun j =>
    Qred (at_ G (S i) (S j) - at_ G (S i) 0 * at_ G 0 (S j) / at_ G 0 0)))) (fun i => v (S i)).
Proof.
  intros Sym D. cbv zeta. set (d := at_ G 0 0) in *.
  set (t := sum (seq 0 n) (fun i => at_ G 0 (S i) * v (S i))).
  assert (E : form n (table n (fun i => table n (fun j =>
      Qred (at_ G (S i) (S j) - at_ G (S i) 0 * at_ G 0 (S j) / d)))) (fun i => v (S i)) ==
    sum (seq 0 n) (fun i => sum (seq 0 n) (fun j => at_ G (S i) (S j) * v (S i) * v (S j)))
      + - (1 / d) * (t * t)).
  { unfold t. rewrite <- (sum_of_products (seq 0 n) (seq 0 n)), sum_pairs. cbn [fst snd].
    rewrite <- sum_times, <- sum_plus. apply sum_ext. intros i Hi. rewrite <- sum_times, <- sum_plus.
    apply sum_ext. intros j Hj. apply in_seq in Hi, Hj. unfold at_ at 1.
    rewrite !nth_table, Qred_correct, (Sym i) by lia. field. exact D. }
  rewrite E. unfold form. rewrite sum_S, sum_S.
  rewrite (sum_ext (seq 0 n) (fun i => sum (seq 0 (S n)) _)
    (fun i => v 0%nat * (at_ G 0 (S i) * v (S i))
    + sum (seq 0 n) (fun j => at_ G (S i) (S j) * v (S i) * v (S j)))).
  2:{ intros i Hi. apply in_seq in Hi. rewrite sum_S, (Sym i) by lia. ring. }
  rewrite sum_plus, sum_times. fold t.
  rewrite (sum_ext (seq 0 n) (fun j => at_ G 0 (S j) * v 0%nat * v (S j))
    (fun j => v 0%nat * (at_ G 0 (S j) * v (S j)))) by (intros; ring).
  rewrite sum_times. fold t d. field. exact D.
Qed.

Lemma positive_definite_is n : forall G v, positive_definite n G = true ->
  0 <= form n G v /\ (form n G v == 0 -> forall i, (i < n)%nat -> v i == 0).
Proof.
  induction n; intros G v H; [split; [apply Qle_refl|intros _ i Hi; lia]|].
  cbn [positive_definite] in H. cbv zeta in H. rewrite !andb_true_iff in H. destruct H as [[D Sym] H].
  apply negb_true_iff in D.
  assert (Pos : 0 < at_ G 0 0).
  { apply Qnot_le_lt. intros L. apply Qle_bool_iff in L. congruence. }
  assert (Nz : ~ at_ G 0 0 == 0) by (intros Z; rewrite Z in Pos; exact (Qlt_irrefl 0 Pos)).
  assert (Sy : forall i, (i < n)%nat -> at_ G (S i) 0 == at_ G 0 (S i)).
  { intros i Hi. apply Qeq_bool_iff, (all_at _ _ Sym i Hi). }
  rewrite (form_S n G v Sy Nz). destruct (IHn _ (fun i => v (S i)) H) as [Non Zero].
  set (rest := form n _ _) in *.
  set (s := at_ G 0 0 * v 0%nat + sum (seq 0 n) (fun i => at_ G 0 (S i) * v (S i))).
  assert (Sq : 0 <= s * s / at_ G 0 0).
  { apply Qmult_le_0_compat; [apply square_nonnegative|]. apply Qinv_le_0_compat, Qlt_le_weak, Pos. }
  split; [apply (Qplus_le_compat 0 _ 0 _); assumption|]. intros E.
  destruct (sum_is_0 _ _ Sq Non E) as [Es Er]. specialize (Zero Er).
  intros [|i] Hi; [|apply Zero; lia].
  apply Qmult_integral in Es. destruct Es as [Es|Es].
  2:{ exfalso. apply Nz. rewrite <- (Qinv_involutive (at_ G 0 0)), Es. reflexivity. }
  assert (Z : s == 0) by (apply Qmult_integral in Es; destruct Es; assumption).
  unfold s in Z. rewrite sum_zero in Z.
  - rewrite Qplus_0_r in Z. apply Qmult_integral in Z. destruct Z; [contradiction|assumption].
  - intros j Hj. apply in_seq in Hj. rewrite (Zero j) by lia. ring.
Qed.

(** ** The form of the weights of a colour *)

Section Weights.
Variable M : method.
Variable lambda : list Q.
(** λ of a number. *)
Definition image (x : V) : Q := sum (seq 0 (degree M)) (fun e => nth e lambda 0 * x e).

Definition gram l : list (list Q) :=
  let T := the_maps M in
  table (dim M l) (fun i => table (dim M l) (fun j =>
    Qred (image (val (Wz T l (Pz T l (zunit i) (zunit j))))))).
Definition definite_by_elimination : bool :=
  all (N M) (fun l => positive_definite (dim M l) (gram l)).

(** A linear map is a sum over its values at units. *)
Lemma on_units n f : linear f -> local n f ->
  forall x, f x == sum (seq 0 n) (fun i => x i * f (unit i)).
Proof.
  intros L Lo x. rewrite (Lo x (cut n x)).
  - clear Lo. induction n.
    + rewrite (l_ext _ L _ (scale 0 (fun _ => 0))); [rewrite (l_scale _ L); apply Qmult_0_l|].
      intros i. unfold scale. symmetry. apply Qmult_0_l.
    + cbn [cut]. rewrite (l_add _ L), (l_scale _ L), IHn, seq_S, sum_app, sum_one. reflexivity.
  - intros j Hj. rewrite cut_at. apply Nat.ltb_lt in Hj. rewrite Hj. reflexivity.
Qed.

Theorem definite_by : definite_by_elimination = true -> definite M.
Proof.
  intros H l Hl v E. pose proof (all_at _ _ H l Hl) as P. cbv beta in P.
  intros i Hi. revert i Hi. apply (proj2 (positive_definite_is _ _ v P)).
  set (g := fun x y => image (fun e => b M l e (mul (Pof M l) x y))).
  assert (Left : forall y, linear (fun x => g x y)).
  { intros y. apply linear_sum. intros e. apply linear_times, (mul_left (b M l e)), b_linear. }
  assert (Right : forall x, linear (g x)).
  { intros x. apply linear_sum. intros e. apply linear_times, (mul_right (b M l e)), b_linear. }
  assert (Local : forall x x' y y', (forall j, (j < dim M l)%nat -> x j == x' j) ->
      (forall j, (j < dim M l)%nat -> y j == y' j) -> g x y == g x' y').
  { intros x x' y y' Hx Hy. apply sum_ext. intros e _. apply Qmult_comp; [reflexivity|].
    apply b_ext, mu_below; assumption. }
  transitivity (g v v).
  - rewrite (on_units (dim M l) (fun x => g x v) (Left v)) by (intros x x' K; apply Local; [exact
      K|reflexivity]).
    unfold form. apply sum_ext. intros i Hi.
    rewrite (on_units (dim M l) (g (unit i)) (Right _)) by (intros x x' K; apply Local;
      [reflexivity|exact K]).
    rewrite <- sum_times. apply sum_ext. intros j Hj. apply in_seq in Hi, Hj.
    unfold at_, gram. rewrite !nth_table, Qred_correct by lia.
    assert (U : image (val (Wz (the_maps M) l (Pz (the_maps M) l (zunit i) (zunit j)))) ==
      g (unit i) (unit j)).
    { apply sum_ext. intros e He. apply in_seq in He. apply Qmult_comp; [reflexivity|].
      rewrite <- (b_val M _ eq_refl l e) by lia. apply b_ext, (P_val M _ eq_refl l), Hl. }
    rewrite U. ring.
  - apply sum_zero. intros e He. apply in_seq in He. rewrite (E e) by lia. unfold rational.
    destruct (Nat.eqb e 0); ring.
Qed.
End Weights.
