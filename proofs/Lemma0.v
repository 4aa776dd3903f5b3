(** * Lemma 0: conditions of a method and conditions of its conjugate

    C(k) of one is D(k) of the other, and the even condition is kept. *)

From Coq Require Import QArith List Arith Lia.
From Gark Require Import Stages Trees Methods Sums Check Pairs Products Conditions.
Import ListNotations.
Open Scope Q_scope.

Lemma other_half x y q : x + y == 2 * q -> x == q -> y == q.
Proof. intros S H. setoid_replace y with (x + y - x) by ring. rewrite S, H. ring. Qed.

Section Lemma0.
Variable M : method.
Variable others : list (list (option (list (list number)))).
(** The conjugate has the field, spaces and colours of the method. *)
Let hat := {| field := field M; spaces := spaces M; colours := colours M; blocks := others |}.
Hypothesis conjugate : is_conjugate M hat.
Variable c : nat -> V.

Lemma both_rational l m e x y q : quadrature M l x q -> (e < degree M)%nat ->
  both M l m e x y == q * b M m e y.
Proof.
  intros H He. unfold both. rewrite times_is.
  rewrite (sum_ext _ _ (fun u => (if Nat.eqb u 0 then 1 else 0) *
    sum (seq 0 (degree M)) (fun v => in_field M e u v * (q * b M m v y)))).
  - rewrite sum_at by lia.
    rewrite (sum_ext _ _ (fun v => (if Nat.eqb v e then 1 else 0) * (q * b M m v y))).
    + rewrite sum_at by exact He. reflexivity.
    + intros v I. apply in_seq in I. rewrite rational_times, Nat.eqb_sym by lia. reflexivity.
  - intros u I. apply in_seq in I. rewrite <- sum_times. apply sum_ext. intros v _.
    rewrite (H u) by lia. unfold rational. destruct (Nat.eqb u 0); ring.
Qed.
Lemma both_swap l m e x y : both M l m e x y == both M m l e y x.
Proof.
  unfold both. rewrite !times_is, sum_swap. apply sum_ext. intros u _. apply sum_ext. intros v _.
  rewrite (commutes _ _ _ (field_algebra M) e). ring.
Qed.

Section Block.
Variable l m : nat.
Hypothesis Hl : (l < N M)%nat.
Hypothesis Hm : (m < N M)%nat.
Hypothesis seen : sees M m l.

Lemma same_powers a j : power_of hat c a j = power_of M c a j.
Proof. induction j; simpl; [reflexivity|]. rewrite IHj. reflexivity. Qed.

(** b_l(x Â y) = b_l(x) b_m(y) − b_m(A x · y). *)
Lemma conjugation e x y : (e < degree M)%nat ->
  b M l e (mul (Pof M l) x (app (Aof hat l m) y)) ==
  both M l m e x y - b M m e (mul (Pof M m) (app (Aof M m l) x) y).
Proof.
  intros He. destruct conjugate as [_ [_ [_ H]]]. destruct (H l m Hl Hm) as [_ K].
  specialize (K seen e x y He). unfold defect in K.
  rewrite <- (Qplus_0_l (both M l m e x y - _)), <- K. ring.
Qed.

Variable k : nat.

Theorem lemma_0_D_of_conjugate : B M c l k -> C M c m l k -> D hat c l m k.
Proof.
  intros Bl Cm j g e Hj He. rewrite !same_powers.
  change (b M l e (mul (Pof M l) (power_of M c l (j - 1)) (app (Aof hat l m) g)) ==
    inverse j * (b M m e g - b M m e (mul (Pof M m) (power_of M c m j) g))).
  rewrite conjugation, (both_rational l m e _ g _ (Bl j Hj)) by assumption.
  rewrite (b_ext M m e (mul (Pof M m) (app (Aof M m l) (power_of M c l (j - 1))) g)
    (scale (inverse j) (mul (Pof M m) (power_of M c m j) g))).
  - rewrite b_scale. ring.
  - eapply veq_trans; [apply mu_below; [apply (Cm j Hj)|intros; reflexivity]|].
    intros i. apply (l_scale _ (mu_left M m g i)).
Qed.

Theorem lemma_0_C_of_conjugate : nondegenerate M -> B M c m k -> D M c m l k -> C hat c l m k.
Proof.
  intros Non Bm Dm j Hj. rewrite !same_powers. apply (equal_by_products M l _ _ Non Hl).
  intros g e He. rewrite conjugation, both_swap by assumption.
  rewrite (both_rational m l e _ g _ (Bm j Hj) He).
  rewrite (b_ext M m e _ _ (mu_comm M m _ _)), (Dm j g e Hj He).
  rewrite (b_ext M l e _ _ (mu_scale M l _ _ _)), b_scale, (b_ext M l e _ _ (mu_comm M l g _)). ring.
Qed.

Theorem lemma_0_even : B M c l (S k) -> B M c m (S k) -> (even hat c l m k <-> even M c m l k).
Proof.
  intros Bl Bm. unfold even. rewrite !same_powers.
  assert (Sum : forall e, (e < degree M)%nat ->
    b M l e (mul (Pof M l) (power_of M c l k) (app (Aof hat l m) (power_of M c m k)))
    + b M m e (mul (Pof M m) (power_of M c m k) (app (Aof M m l) (power_of M c l k)))
    == 2 * rational (inverse (2 * S k * S k)) e).
  { intros e He. rewrite conjugation by exact He.
    pose proof (Bl (S k) ltac:(lia)) as X. replace (S k - 1)%nat with k in X by lia.
    pose proof (Bm (S k) ltac:(lia) e He) as Y. replace (S k - 1)%nat with k in Y by lia.
    rewrite (both_rational l m e _ _ _ X He), Y.
    rewrite (b_ext M m e _ _ (mu_comm M m (power_of M c m k) _)).
    unfold rational. destruct (Nat.eqb e 0); [|ring].
    rewrite !number_of_inverse, !number_of_times by lia. change (number_of 2) with 2.
    field. apply number_of_not_0. lia. }
  split; intros H e He; specialize (Sum e He); specialize (H e He).
  - exact (other_half _ _ _ Sum H).
  - rewrite Qplus_comm in Sum. exact (other_half _ _ _ Sum H).
Qed.
End Block.

(** The method is the conjugate of its conjugate. *)
Lemma conjugate_back : is_conjugate hat M.
Proof.
  destruct conjugate as [_ [_ [_ H]]]. repeat (split; [reflexivity|]). intros l m Hl Hm.
  split; [symmetry; apply (H m l Hm Hl)|]. intros S e x y He.
  destruct (H m l Hm Hl) as [S' K]. specialize (K (proj1 S' S) e y x He).
  rewrite <- K. unfold defect.
  change (both hat l m e x y) with (both M l m e x y). rewrite both_swap.
  change (b hat) with (b M). change (Pof hat) with (Pof M).
  rewrite (b_ext M l e _ _ (mu_comm M l x _)), (b_ext M m e _ _ (mu_comm M m _ y)). ring.
Qed.
End Lemma0.

(** The converse statements, which are those for the conjugate of the conjugate. *)
Theorem lemma_0_of_method M others c l m k :
  let hat := {| field := field M; spaces := spaces M; colours := colours M; blocks := others |} in
  is_conjugate M hat -> (l < N M)%nat -> (m < N M)%nat -> sees M m l ->
  (B M c m k -> C hat c l m k -> D M c m l k) /\
  (nondegenerate M -> B M c l k -> D hat c l m k -> C M c m l k).
Proof.
  intros hat Con Hl Hm Seen. pose proof (conjugate_back M others Con) as Back.
  assert (S : sees hat l m) by (apply Con; assumption).
  destruct M as [f s cs bs]. split.
  - exact (lemma_0_D_of_conjugate hat bs Back c m l Hm Hl S k).
  - exact (lemma_0_C_of_conjugate hat bs Back c m l Hm Hl S k).
Qed.
